float pnb_sphere_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  vec3 to = l.position - p;
  float d2 = dot(to, to), r2 = l.radius * l.radius;
  if (d2 <= 0.0) return r2 > 0.0 ? pnb_pi : 0.0;
  return pnb_cone_irradiance(clamp(dot(n, to) / sqrt(d2), -1.0, 1.0), min(1.0, r2 / d2), centre);
}
