// Points of a light: the patterns of src/shadow/light_samples.h, chosen for every pixel there.
uniform highp sampler2D pnb_patterns;  // of this pixel: table, turn in radians, shift
uniform highp sampler2D pnb_points;    // tables of points: on the square, on the disk
uniform int pnb_first_point, pnb_last_point;  // of this draw
uniform int pnb_point_total, pnb_points_in_table;

// The area of a mesh light that can be seen from p.
float pnb_seen_area(pnb_Light l, vec3 p) {
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6) return pnb_seen_faces(l, p).w;
#endif
  return 0.0;
}

// Direction, distance and weight of point i as seen from p.
void pnb_light_point(pnb_Light l, vec3 p, vec4 pattern, int i, float seen_area,
                     out vec3 direction, out float reach, out float weight) {
  int at = int(pattern.x + 0.5) * pnb_points_in_table + i;
  vec4 q = texelFetch(pnb_points, ivec2(at & 1023, at >> 10), 0);
  float c = cos(pattern.y), s = sin(pattern.y);
  vec2 disk = vec2(c * q.z - s * q.w, s * q.z + c * q.w), square = q.xy + pattern.zw;
  square -= vec2(greaterThanEqual(square, vec2(1.0)));
  vec3 to = l.position - p;
  float d = length(to);
  if (l.type == 1 || l.type == 5) {
    bool sun = l.type == 5;
    float sine = sun ? 0.0 : l.radius / max(d, 1e-30);
    float half_chord2 = 0.5 * l.sin2 / (1.0 + sqrt(1.0 - l.sin2));  // sin^2 of half the half angle
    float one_minus_cos =
        sun ? 2.0 * half_chord2 : sine >= 1.0 ? 2.0 : sine * sine / (1.0 + sqrt(1.0 - sine * sine));
    mat3 frame = pnb_frame(sun ? l.normal : d > 0.0 ? to / d : vec3(0.0, 1.0, 0.0));
    float u = dot(disk, disk), z = 1.0 - u * one_minus_cos;
    float across = sqrt(max(0.0, one_minus_cos * (1.0 + z)));
    direction = frame * vec3(disk * across, z);
    float sine2 = u * one_minus_cos * (1.0 + z);
    float chord = sqrt(max(0.0, l.radius * l.radius - d * d * sine2));
    reach = sun ? 1e30 : d > l.radius ? d * z - chord : d * z + chord;
    weight = sun ? 1.0 : 2.0 * pnb_pi * one_minus_cos;
    return;
  }
  vec3 point = l.position, normal = l.normal;
  if (l.type == 2) point += pnb_frame(l.normal) * vec3(disk * l.radius, 0.0);
  if (l.type == 3) point += l.edge_u * (square.x - 0.5) + l.edge_v * (square.y - 0.5);
  if (l.type == 4) point += l.edge_u * (square.x - 0.5);
  bool two_sided = false;
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6) {
    point = pnb_on_faces(l, p, square, seen_area, normal);
    two_sided = pnb_faces_of(l).double_sided;
  }
#endif
  to = point - p;
  reach = max(length(to), 1e-30);
  direction = to / reach;
  float area = l.type == 2   ? pnb_pi * l.radius * l.radius
               : l.type == 3 ? length(cross(l.edge_u, l.edge_v))
               : l.type == 4 ? 2.0 * l.radius * length(cross(l.edge_u, direction))
               : l.type == 6 ? seen_area
                             : 1.0;
  if (l.type == 2 || l.type == 3 || l.type == 6) {
    float facing = -dot(direction, normal);
    area *= max(two_sided ? abs(facing) : facing, 0.0);
  }
  weight = area / (reach * reach);
  if (l.type == 2 || l.type == 3 || l.type == 6) reach = pnb_short_of(reach, p, direction, normal);
}
