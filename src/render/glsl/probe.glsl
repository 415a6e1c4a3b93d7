// Visible fractions at points.
uniform highp sampler2D pnb_positions;  // xyz
uniform highp sampler2D pnb_normals;    // xyz

layout(location = 0) out vec4 pnb_out0;  // visible fraction, notes

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 p = texelFetch(pnb_positions, at, 0).xyz, n = texelFetch(pnb_normals, at, 0).xyz;
  pnb_Light l = pnb_light_at(0);
#ifdef PNB_BY_POINTS
  vec4 pattern = texelFetch(pnb_patterns, at, 0);
  float seen = 0.0, seen_area = pnb_seen_area(l, p);
  for (int i = pnb_first_point; i < pnb_last_point; ++i) {
    vec3 d;
    float reach, weight;
    pnb_light_point(l, p, pattern, i, seen_area, d, reach, weight);
    if (dot(n, d) > 0.0) seen += pnb_visible(p, n, d, reach, l.own);
  }
  float fraction = seen / float(pnb_point_total);
#else
  float fraction = pnb_fraction(l, p, n);
#endif
  pnb_out0 = vec4(fraction, pnb_notes(false), 0.0, 0.0);
}
