// Distances to meshes as mesh_grid.h has them: a sparse grid, and near the surface the triangles.
uniform highp sampler2D pnb_mesh_texels;

struct pnb_Grid {
  int nodes, values;             // first texels: of the octree, of the bricks' corners
  int table, depth, side;        // side^3 nodes about the middle, `depth` below the root, as pairs:
                                 // of a node, of the bits of its cells' numbers
  int boxes, box_count;          // of the triangles' boxes, parents first: two texels each
  int triangles;                 // of the triangles: three texels each
  int levels;                    // of the octree
  float voxel, ball, threshold;  // ball: of the mesh; winding numbers above the last are inside
};

vec4 pnb_texel(int i) { return texelFetch(pnb_mesh_texels, ivec2(i & 4095, i >> 12), 0); }

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

// The distance to the triangles where it is below `most`, else that.
float pnb_triangles(pnb_Grid g, vec3 p, float most) {
  float best = most * most;
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
      best = min(best, pnb_triangle2(p, a.xyz, pnb_texel(t + 1).xyz, pnb_texel(t + 2).xyz));
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
  float d = pnb_triangles(g, p, (m + 0.87) * h);
  float far = m > 3.0 ? pnb_less_error(m) * h : 0.0;
  float result = d + clamp(m - 3.0, 0.0, 1.0) * (far - d);
  return with_sign && pnb_is_inside(g, p, v, at, nearest, d) ? -result : result;
}
