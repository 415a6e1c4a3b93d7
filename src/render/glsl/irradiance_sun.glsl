// Per unit irradiance of a surface that faces it.
float pnb_sun_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  float cos_centre = dot(n, l.normal);
  if (l.sin2 < 1e-12) return max(0.0, cos_centre);
  return pnb_cone_irradiance(cos_centre, l.sin2, centre) / (pnb_pi * l.sin2);
}
