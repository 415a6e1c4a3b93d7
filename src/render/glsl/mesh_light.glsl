
// Mesh lights, as src/shadow/mesh_light.h has them: the faces that are turned to a point.
vec4 pnb_light_texel(int i);

struct pnb_Faces {
  int nodes, node_count;  // of their tree: four texels each
  int faces, face_count;  // four texels each
  int patches, patch_count, fine, fine_count;  // points of the surface: two texels each
  bool all_count;         // wherever the point is
  bool flat_;             // all in one plane
  bool double_sided;      // emits to both sides
  bool seen_within;       // and its inside is seen
};

pnb_Faces pnb_faces_of(pnb_Light l) {
  ivec4 a = ivec4(pnb_light_texel(l.mesh)), b = ivec4(pnb_light_texel(l.mesh + 1));
  bvec4 flags = greaterThan(pnb_light_texel(l.mesh + 2), vec4(0.5));
  return pnb_Faces(a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w, flags.x, flags.y, flags.z, flags.w);
}

// 1: all faces of the node are turned to p, -1: none is, 0: perhaps some.
int pnb_turned_node(pnb_Faces f, int node, vec3 p) {
  vec4 ball = pnb_light_texel(f.nodes + 4 * node), cone = pnb_light_texel(f.nodes + 4 * node + 1);
  vec3 way = p - ball.xyz;
  float away = length(way), slack = ball.w + 1e-5 * (away + ball.w), along = dot(way, cone.xyz);
  float across = sqrt(max(0.0, away * away - along * along));
  float sine = sqrt(max(0.0, 1.0 - cone.w * cone.w));
  float most = along >= cone.w * away ? away : along * cone.w + across * sine;
  float least = -along >= cone.w * away ? -away : along * cone.w - across * sine;
  return least > slack ? 1 : most < -slack ? -1 : 0;
}

// Moment and area of a face; 0 if it is turned away from p.
vec4 pnb_turned_face(pnb_Faces f, int face, vec3 p) {
  int at = f.faces + 4 * face;
  vec4 a = pnb_light_texel(at);
  if (dot(pnb_light_texel(at + 3).xyz, p - a.xyz) <= 0.0) return vec4(0.0);
  vec3 sum = a.xyz + pnb_light_texel(at + 1).xyz + pnb_light_texel(at + 2).xyz;
  return vec4(sum / 3.0 * a.w, a.w);
}

// Moment and area of the faces that can light p; of all where none is turned to it. `face`: the
// one within which the sum of areas comes to `wanted`, `left`: how much of it belongs to that sum.
vec4 pnb_walk_faces(pnb_Faces f, vec3 p, float wanted, out int face, out float left) {
  vec4 sum = vec4(0.0);
  ivec2 run = ivec2(0, f.face_count);  // faces among which it is
  float before = 0.0;                  // area of those that count before them
  bool found = false;
  for (int i = f.all_count ? f.node_count : 0; i < f.node_count && !found;) {
    int turned = pnb_turned_node(f, i, p), at = f.nodes + 4 * i;
    vec4 node = pnb_light_texel(at + 3);
    if (turned == 0 && node.w == 0.0) {
      ++i;
      continue;
    }
    i = int(node.z);
    if (turned < 0) continue;
    ivec2 faces = ivec2(node.xy);
    while (faces.x < faces.y && !found) {
      ivec2 next = ivec2(faces.x, turned > 0 ? faces.y : faces.x + 1);
      vec4 part = turned > 0 ? pnb_light_texel(at + 2) : pnb_turned_face(f, faces.x, p);
      faces.x = next.y;
      if (part.w <= 0.0) continue;
      run = next;
      before = sum.w;
      sum += part;
      found = sum.w > wanted;
    }
  }
  if (sum.w <= 0.0) sum = pnb_light_texel(f.nodes + 2);
  left = wanted - before;
  if (run.x > 0) left += pnb_light_texel(f.faces + 4 * run.x - 3).w;
  while (run.x < run.y - 1) {
    int middle = (run.x + run.y - 2) >> 1;
    if (pnb_light_texel(f.faces + 4 * middle + 1).w > left)
      run.y = middle + 1;
    else
      run.x = middle + 1;
  }
  face = run.x;
  if (face > 0) left -= pnb_light_texel(f.faces + 4 * face - 3).w;
  return sum;
}

vec4 pnb_seen_faces(pnb_Light l, vec3 p) {
  int face;
  float left;
  return pnb_walk_faces(pnb_faces_of(l), p, 1e30, face, left);
}

// Of the light's seen area, where the point x, y of the unit square is, and its face's normal.
vec3 pnb_on_faces(pnb_Light l, vec3 p, vec2 square, float area, out vec3 normal) {
  pnb_Faces f = pnb_faces_of(l);
  int face;
  float left;
  pnb_walk_faces(f, p, square.x * area, face, left);
  int at = f.faces + 4 * face;
  vec4 a = pnb_light_texel(at);
  normal = pnb_light_texel(at + 3).xyz;
  float root = sqrt(clamp(left / a.w, 0.0, 1.0));
  return a.xyz * (1.0 - root) + pnb_light_texel(at + 1).xyz * (root * (1.0 - square.y)) +
         pnb_light_texel(at + 2).xyz * (root * square.y);
}
