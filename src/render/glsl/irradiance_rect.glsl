float pnb_rect_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  vec3 to = l.position - p, u = 0.5 * l.edge_u, v = 0.5 * l.edge_v;
  if (dot(l.normal, to) >= 0.0) return 0.0;
  return pnb_quad_irradiance(vec3[4](to - u - v, to + u - v, to + u + v, to - u + v), n, centre);
}
