// A segment as a line: the integral of cosine, apparent width and distance along it.
float pnb_segment_part(float h, float foot_height, float slope, float from, float till) {
  float h2 = h * h, d0 = h2 + from * from, d1 = h2 + till * till;
  // The difference of two arc tangents, as one.
  float turn = pnb_angle(h2 + from * till, h * (till - from));
  float level = 0.5 * (till / (h * d1) - from / (h * d0)) + 0.5 * turn / h2;
  float rising = 0.5 * h * (till - from) * (till + from) / (d0 * d1);
  return foot_height * level + slope * rising;
}

float pnb_segment_irradiance(pnb_Light l, vec3 p, vec3 n, bool centre) {
  vec3 start = l.position - 0.5 * l.edge_u - p;
  float size = length(l.edge_u);
  if (size <= 0.0 || l.radius <= 0.0) return 0.0;
  vec3 along = l.edge_u / size;
  float from = dot(start, along), till = from + size;
  vec3 foot = start - along * from;
  float foot_height = dot(n, foot), slope = dot(n, along);
  if (!centre && slope != 0.0) {
    float sets = -foot_height / slope;
    if (slope > 0.0) from = clamp(sets, from, till);
    else till = clamp(sets, from, till);
  }
  float h = max(length(foot), l.radius);
  float e = 2.0 * l.radius * pnb_segment_part(h, foot_height, slope, from, till);
  return clamp(e, 0.0, pnb_pi);
}
