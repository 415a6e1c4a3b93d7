
// How far a shadow ray to `reach` along `direction` goes: what lies on a flat light's own plane,
// whose normal is given, does not block it.
float pnb_short_of(float reach, vec3 p, vec3 direction, vec3 normal) {
  vec3 a = max(abs(p), abs(p + direction * reach));
  return reach - 4e-5 * max(a.x, max(a.y, a.z)) / max(abs(dot(direction, normal)), 1e-4);
}

// Direction and distance of the light's centre, and w, the tangent of half the angle it fills.
// False where there is no such direction.
bool pnb_view(pnb_Light l, vec3 p, out vec3 direction, out float distance_, out float w) {
  vec3 to = l.position - p;
  float diameter = l.diameter;
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6) {
    vec4 seen = pnb_seen_faces(l, p);
    to = seen.xyz / seen.w - p;
    diameter = 2.0 * sqrt(seen.w / pnb_pi);
  }
#endif
  float d = length(to);
  bool sun = l.type == 5;
  direction = sun ? l.normal : d > 0.0 ? to / d : vec3(0.0, 1.0, 0.0);
  distance_ = sun ? 1e30 : d;
  w = 0.5 * diameter / (sun ? 1.0 : max(d, 1e-30));
  return sun || d > 0.0;
}

// The distance before which the centre's ray is blocked.
float pnb_centre_reach(pnb_Light l, vec3 p, vec3 direction, float distance_) {
  bool flat_ = l.type == 2 || l.type == 3;
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6) flat_ = pnb_faces_of(l).flat_;
#endif
  return flat_ ? pnb_short_of(distance_, p, direction, l.normal) : distance_;
}
