// A convex polygon of four vertices, relative to the point: Lambert's contour. One vertex may
// stand twice.
float pnb_edge(vec3 a, vec3 b, vec3 n) {
  vec3 c = cross(a, b - a);
  float sine = length(c);
  return sine > 0.0 ? dot(c, n) * (pnb_angle(dot(a, b), sine) / sine) : 0.0;
}

float pnb_quad_irradiance(vec3 corner[4], vec3 n, bool centre) {
  bool above = false, below = false;
  for (int i = 0; i < 4; ++i) {
    if (dot(corner[i], n) >= 0.0) above = true;
    else below = true;
  }
  if (!above) return 0.0;
  float sum = 0.0;
  if (!below || centre) {
    for (int i = 0; i < 4; ++i) sum += pnb_edge(corner[i], corner[(i + 1) & 3], n);
    bool turned = dot(corner[0], cross(corner[1] - corner[0], corner[2] - corner[0])) < 0.0;
    return max(0.0, turned ? -0.5 * sum : 0.5 * sum);
  }
  // What is above the horizon (Sutherland and Hodgman 1974): its edges, then the one that closes it.
  vec3 leaves = vec3(0.0), enters = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 a = corner[i], b = corner[(i + 1) & 3];
    float ha = dot(a, n), hb = dot(b, n);
    vec3 cut = a + (b - a) * ((ha < 0.0) != (hb < 0.0) ? ha / (ha - hb) : 0.0);
    if (ha >= 0.0 && hb < 0.0) leaves = cut;
    if (ha < 0.0 && hb >= 0.0) enters = cut;
    if (ha >= 0.0 || hb >= 0.0)
      sum += pnb_edge(ha >= 0.0 ? a : cut, hb >= 0.0 ? b : cut, n);
  }
  return abs(0.5 * (sum + pnb_edge(leaves, enters, n)));
}
