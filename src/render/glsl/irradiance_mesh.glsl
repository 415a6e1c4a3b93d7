// Few faces one by one, many as points of their surface.
float pnb_mesh_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  pnb_Faces f = pnb_faces_of(l);
  float sum = 0.0;
  for (int i = pnb_zero; i < f.fine_count; ++i) {
    vec4 at = pnb_light_texel(f.fine + 2 * i);
    vec3 to = at.xyz - p;
    float d2 = dot(to, to), up = dot(to, n);
    float facing = -dot(to, pnb_light_texel(f.fine + 2 * i + 1).xyz);
    if (f.seen_within) facing = abs(facing);
    if (up > 0.0 && facing > 0.0) sum += at.w * facing * up / (d2 * (d2 + at.w / pnb_pi));
  }
  int count = f.fine_count > 0 ? 0 : f.face_count;
  for (int i = pnb_zero; i < count; ++i) {
    int at = f.faces + 4 * i;
    vec3 a = pnb_light_texel(at).xyz - p;
    if (!f.seen_within && dot(pnb_light_texel(at + 3).xyz, a) >= 0.0) continue;
    vec3 b = pnb_light_texel(at + 1).xyz - p, c = pnb_light_texel(at + 2).xyz - p;
    sum += pnb_quad_irradiance(vec3[4](a, b, c, c), n, centre);
  }
  return min(sum, pnb_pi);
}
