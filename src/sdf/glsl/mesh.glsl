// Distances to meshes as mesh_grid.h has them: a sparse grid, and near the surface the triangles.

struct pnb_Grid {
  int nodes, values;             // first texels: of the octree, of the bricks' corners
  int table, depth, side;        // side^3 nodes about the middle, `depth` below the root, as pairs:
                                 // of a node, of the bits of its cells' numbers
  int boxes, box_count;          // of the triangles' boxes, parents first: two texels each
  int triangles;                 // of the triangles: three texels each
  int levels;                    // of the octree
  float voxel, ball, threshold;  // ball: of the mesh; winding numbers above the last are inside
};

float pnb_number(int first, int i) { return pnb_texel(first + (i >> 2))[i & 3]; }

// The last six bits of a corner's distance say how often the mesh winds around it. Of a mesh with
// holes that is no whole number, and nearly the same at points about the corner: signs are wrong
// where it is nearly the threshold, about the edges of holes.
float pnb_winding_in(float value) { return float(floatBitsToInt(value) & 63) / 16.0 - 1.0; }

float pnb_squared(vec3 v) { return dot(v, v); }

float pnb_edge2(vec3 e, vec3 v) {
  return pnb_squared(e * clamp(dot(e, v) / max(pnb_squared(e), 1e-30), 0.0, 1.0) - v);
}

// Squared distance to a triangle (Quilez, "distance functions", udTriangle).
float pnb_triangle2(vec3 p, vec3 a, vec3 b, vec3 c) {
  vec3 ab = b - a, bc = c - b, ca = a - c, pa = p - a, pb = p - b, pc = p - c, n = cross(ab, ca);
  float nn = dot(n, n);
  if (nn > 0.0 && dot(cross(ab, n), pa) >= 0.0 && dot(cross(bc, n), pb) >= 0.0 &&
      dot(cross(ca, n), pc) >= 0.0) {
    float h = dot(n, pa);
    return h * h / nn;
  }
  return min(pnb_edge2(ab, pa), min(pnb_edge2(bc, pb), pnb_edge2(ca, pc)));
}

// The distance to the triangles where it is below `most`, else that; the first texel of the nearest,
// -1 if none is so near.
float pnb_triangles(pnb_Grid g, vec3 p, float most, out int nearest) {
  float best = most * most;
  nearest = -1;
  for (int i = 0; i < g.box_count;) {
    vec4 lo = pnb_texel(g.boxes + 2 * i), hi = pnb_texel(g.boxes + 2 * i + 1);
    if (pnb_squared(max(max(lo.xyz - p, p - hi.xyz), 0.0)) >= best) {
      i = int(lo.w);
      continue;
    }
    ++i;
    if (hi.w < 0.0) continue;
    vec4 a = vec4(0.0);
    for (int t = g.triangles + 3 * int(hi.w); a.w == 0.0; t += 3) {
      a = pnb_texel(t);
      float d = pnb_triangle2(p, a.xyz, pnb_texel(t + 1).xyz, pnb_texel(t + 2).xyz);
      if (d < best) nearest = t;
      best = min(best, d);
    }
  }
  return sqrt(best);
}

// 1 if the way ends behind the triangle and begins before it, -1 the other way round.
float pnb_crossing(vec3 a, vec3 b, vec3 c, vec3 way) {
  vec3 n = cross(b - a, c - a);
  bool begins_behind = dot(n, a) > 0.0, ends_behind = dot(n, a - way) > 0.0;
  if (begins_behind == ends_behind) return 0.0;
  bool ab = dot(way, cross(a, b)) > 0.0, bc = dot(way, cross(b, c)) > 0.0,
       ca = dot(way, cross(c, a)) > 0.0;
  return ab != bc || bc != ca ? 0.0 : ends_behind ? 1.0 : -1.0;
}

float pnb_crossings(pnb_Grid g, vec3 from, vec3 to) {
  vec3 way = to - from;
  vec3 inverse = 1.0 / mix(way, vec3(1e-30), lessThan(abs(way), vec3(1e-30)));
  float sum = 0.0;
  for (int i = 0; i < g.box_count;) {
    vec4 lo = pnb_texel(g.boxes + 2 * i), hi = pnb_texel(g.boxes + 2 * i + 1);
    vec3 u = (lo.xyz - from) * inverse, v = (hi.xyz - from) * inverse;
    vec3 enter = min(u, v), leave = max(u, v);
    if (max(max(enter.x, enter.y), max(enter.z, 0.0)) >
        1.00001 * min(min(leave.x, leave.y), min(leave.z, 1.0))) {
      i = int(lo.w);
      continue;
    }
    ++i;
    if (hi.w < 0.0) continue;
    vec4 a = vec4(0.0);
    for (int t = g.triangles + 3 * int(hi.w); a.w == 0.0; t += 3) {
      a = pnb_texel(t);
      sum += pnb_crossing(a.xyz - from, pnb_texel(t + 1).xyz - from, pnb_texel(t + 2).xyz - from,
                          way);
    }
  }
  return sum;
}

vec3 pnb_to_corner(int i, vec3 at) { return vec3(i & 1, i >> 1 & 1, i >> 2) - at; }

bool pnb_is_inside(pnb_Grid g, vec3 p, float v[8], vec3 at, int nearest, float d) {
  for (int i = 0; i < 8; ++i)
    if (max(abs(v[i]), d) > 1.001 * length(pnb_to_corner(i, at)) * g.voxel) return v[i] < 0.0;
  float between = pnb_crossings(g, p + pnb_to_corner(nearest, at) * g.voxel, p);
  return pnb_winding_in(v[nearest]) + between > g.threshold;
}

// The trilinear value less what it may be too much, both in cells.
float pnb_less_error(float m) { return m - 0.25 / (m - 1.7320508); }

// The distance to a mesh in its own frame, where its longest side is 1.
float pnb_grid(pnb_Grid g, vec3 p, bool with_sign) {
  int half_side = 4 << (g.levels - 1);
  vec3 s = p / g.voxel;
  if (!(max(abs(s.x), max(abs(s.y), abs(s.z))) < float(half_side))) return length(p) - g.ball;
  ivec3 cell = clamp(ivec3(floor(s)) + half_side, ivec3(0), ivec3(2 * half_side - 1));
  int shift = g.levels + 2;
  float node = pnb_number(g.nodes, 0);
  ivec3 middle = (cell >> (shift - g.depth)) - (((1 << g.depth) - g.side) >> 1);
  if (all(greaterThanEqual(middle, ivec3(0))) && all(lessThan(middle, ivec3(g.side)))) {
    int entry = 2 * (middle.x + g.side * (middle.y + g.side * middle.z));
    node = pnb_number(g.table, entry);
    shift = int(pnb_number(g.table, entry + 1));
  }
  while (node >= 0.0) {
    --shift;
    ivec3 octant = (cell >> shift) & 1;
    node = pnb_number(g.nodes, int(node) + octant.x + 2 * octant.y + 4 * octant.z);
  }
  int level = shift - 3, brick = int(-1.0 - node);
  float size = float(1 << level), h = g.voxel * size;
  vec3 at = clamp((s - vec3(((cell >> level) << level) - half_side)) / size, 0.0, 1.0);
  ivec3 corner = (cell >> level) & 7;
  int first = 729 * brick + corner.x + 9 * (corner.y + 9 * corner.z);
  float v[8];
  for (int i = 0; i < 8; ++i)
    v[i] = pnb_number(g.values, first + (i & 1) + 9 * (i >> 1 & 1) + 81 * (i >> 2));
  vec4 x = mix(abs(vec4(v[0], v[2], v[4], v[6])), abs(vec4(v[1], v[3], v[5], v[7])), at.x);
  vec2 y = mix(x.xz, x.yw, at.y);
  float m = mix(y.x, y.y, at.z) / h;
  ivec3 half_up = ivec3(greaterThan(at, vec3(0.5)));
  int nearest = half_up.x + 2 * half_up.y + 4 * half_up.z;
  if (level > 0 || m >= 4.0) {
    float d = pnb_less_error(m) * h;
    return with_sign && v[nearest] < 0.0 ? -d : d;
  }
  int nearest_triangle;
  float d = pnb_triangles(g, p, (m + 0.87) * h, nearest_triangle);
  float far = m > 3.0 ? pnb_less_error(m) * h : 0.0;
  float result = d + clamp(m - 3.0, 0.0, 1.0) * (far - d);
  return with_sign && pnb_is_inside(g, p, v, at, nearest, d) ? -result : result;
}

// Record k of the instances, 14 texels: a row of the map to the grid's frame in each of the first
// three, of the map back, of that of normals with scale, material and instance behind them; the grid;
// the corners' numbers, the vertices, texels of a vertex, 1 = with normals; the ball around it, of
// negative radius if the shape has a formula for its distances.
int pnb_mesh_record(int k) { return pnb_first_mesh + 1 + 14 * k; }

vec3 pnb_mapped(int rows, vec4 p) {
  return vec3(dot(pnb_texel(rows), p), dot(pnb_texel(rows + 1), p), dot(pnb_texel(rows + 2), p));
}

pnb_Grid pnb_grid_of(int record) {
  vec4 a = pnb_texel(record + 9), b = pnb_texel(record + 10), c = pnb_texel(record + 11);
  return pnb_Grid(int(a.x), int(a.y), int(a.z), int(a.w), int(b.x), int(b.y), int(b.z), int(b.w),
                  int(c.x), c.y, c.z, c.w);
}

// The field with the meshes, d without. What is so far that the ball around it is further than d is
// left out: distances are at least 5/6 of those to it.
float pnb_with_meshes(vec3 p, float d, bool with_sign, bool by_size) {
  int count = int(pnb_texel(pnb_first_mesh).x);
  for (int k = 0;; ++k) {
    // A loop of its own, for software drivers run whatever stands in a loop, branched over or not.
    for (; k < count; ++k) {
      vec4 ball = pnb_texel(pnb_mesh_record(k) + 13);
      if (ball.w < 0.0 || 0.8 * (length(p - ball.xyz) - ball.w) > abs(d)) continue;
      if (with_sign || pnb_left_out < 0) break;
      if (int(pnb_texel(pnb_mesh_record(k) + 8).w) != pnb_left_out) break;
    }
    if (k >= count) return d;
    int record = pnb_mesh_record(k);
    vec3 q = pnb_mapped(record, vec4(p, 1.0));
    float e = pnb_texel(record + 6).w * pnb_grid(pnb_grid_of(record), q, with_sign);
    d = by_size ? pnb_nearer(d, e) : min(d, e);
  }
}

// A triangle that a ray has met.
struct pnb_Facet {
  int record;  // of its instance; -1: none is met
  vec3 position, normal;  // there, unit, by the winding
  bool is_smooth;         // has vertex normals
  vec3 smooth_normal;     // unit; of the normal's side
  vec3 lifted, sunk;      // raised to what the vertex normals describe: seen from the front, the back
  vec4 uv;                // both sets
  vec2 uv_per_metre;
};

// A corner's share of the way up to the planes across the vertex normals (Hanika 2021, section 4.3).
vec3 pnb_lift(vec3 p, vec3 corner, vec3 normal, float weight) {
  return normal * (weight * -min(0.0, dot(p - corner, normal)));
}

// The facet within `most` of p that is nearest to it; where the ray meets its plane.
pnb_Facet pnb_facet(vec3 p, vec3 rd, inout float most) {
  pnb_Facet f;
  f.record = -1;
  int triangle = 0, count = int(pnb_texel(pnb_first_mesh).x);
  for (int k = 0;; ++k) {
    for (; k < count; ++k) {
      vec4 ball = pnb_texel(pnb_mesh_record(k) + 13);
      if (length(p - ball.xyz) - abs(ball.w) <= most) break;
    }
    if (k >= count) break;
    int record = pnb_mesh_record(k), nearest;
    float scale = pnb_texel(record + 6).w;
    vec3 q = pnb_mapped(record, vec4(p, 1.0));
    float d = scale * pnb_triangles(pnb_grid_of(record), q, most / scale, nearest);
    if (nearest >= 0) most = d, triangle = nearest, f.record = record;
  }
  if (f.record < 0) return f;
  vec4 b = pnb_texel(triangle + 1);
  vec3 corner[3], q = pnb_mapped(f.record, vec4(p, 1.0));
  corner[0] = pnb_texel(triangle).xyz, corner[1] = b.xyz, corner[2] = pnb_texel(triangle + 2).xyz;
  vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], n = cross(u, v);
  vec3 way = pnb_mapped(f.record, vec4(rd, 0.0));
  float facing = dot(way, n), height = dot(corner[0] - q, n);
  if (abs(facing) > 0.05 * length(way) * length(n)) q += way * (height / facing);
  float nn = max(dot(n, n), 1e-30);
  vec3 to = q - corner[0];
  vec3 weight = clamp(vec3(0.0, dot(cross(to, v), n) / nn, dot(cross(u, to), n) / nn), 0.0, 1.0);
  weight.x = max(0.0, 1.0 - weight.y - weight.z);
  for (int i = 0; i < 3; ++i) corner[i] = pnb_mapped(f.record + 3, vec4(corner[i], 1.0));
  f.position = corner[0] * weight.x + corner[1] * weight.y + corner[2] * weight.z;
  // A triangle of the grid's frame has its front where its mesh has it, whatever mirrors there are.
  f.normal = normalize(pnb_texel(f.record).xyz * n.x + pnb_texel(f.record + 1).xyz * n.y +
                       pnb_texel(f.record + 2).xyz * n.z);
  vec4 table = pnb_texel(f.record + 12);
  vec3 vertex = pnb_texel(int(table.x) + int(b.w)).xyz;
  vec3 normal[3];
  vec4 uv[3];
  f.is_smooth = table.w > 0.0;
  for (int i = 0; i < 3; ++i) {
    int at = int(table.y) + int(table.z) * int(vertex[i]);
    normal[i] = f.is_smooth ? pnb_mapped(f.record + 6, vec4(pnb_texel(at).xyz, 0.0)) : f.normal;
    normal[i] /= max(length(normal[i]), 1e-30);
    uv[i] = table.z > 1.0 ? pnb_texel(at + 1) : vec4(0.0);
  }
  vec3 sum = normal[0] * weight.x + normal[1] * weight.y + normal[2] * weight.z;
  float size = length(sum);
  // Below a third the vertex normals contradict one another or the facet: no smooth surface.
  if (size <= 0.33 || dot(sum, f.normal) < 0.33 * size) f.is_smooth = false;
  f.smooth_normal = f.is_smooth ? sum / size : f.normal;
  f.lifted = f.sunk = f.position;
  for (int i = 0; i < 3; ++i) {
    f.lifted += pnb_lift(f.position, corner[i], normal[i], weight[i]);
    f.sunk += pnb_lift(f.position, corner[i], -normal[i], weight[i]);
  }
  f.uv = uv[0] * weight.x + uv[1] * weight.y + uv[2] * weight.z;
  vec4 du = uv[1] - uv[0], dv = uv[2] - uv[0];
  float area = length(cross(corner[1] - corner[0], corner[2] - corner[0]));
  f.uv_per_metre = sqrt(abs(du.xz * dv.yw - du.yw * dv.xz) / max(area, 1e-30));
  return f;
}
