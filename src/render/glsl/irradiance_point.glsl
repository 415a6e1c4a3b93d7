float pnb_point_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  vec3 to = l.position - p;
  float d2 = max(dot(to, to), 1e-12), d = sqrt(d2);
  float s = clamp(-dot(l.normal, to) / d * l.spot.x + l.spot.y, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s) * max(0.0, dot(n, to)) / (d2 * d);
}
