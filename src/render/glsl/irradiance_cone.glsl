// Irradiance per unit radiance of a cone of directions (Snyder 1996). `centre`: what is below the
// horizon counts with its negative cosine.
float pnb_cone_irradiance(float cos_centre, float sin2, bool centre) {
  if (centre || cos_centre * cos_centre >= sin2) return pnb_pi * sin2 * max(cos_centre, 0.0);
  float sin_centre = sqrt(max(0.0, 1.0 - cos_centre * cos_centre));
  float cot = sqrt((1.0 - sin2) / sin2);
  float y = clamp(-cot * cos_centre / max(sin_centre, 1e-30), -1.0, 1.0);
  float half_chord = sin_centre * sqrt(max(0.0, 1.0 - y * y));
  // atan(x) - cot sin2 half_chord = x sin2 + (atan(x) - x), the last by its series.
  float x = half_chord / max(cot, 1e-30), x2 = x * x;
  float rest = x < 0.3
                   ? -x * x2 * (1.0 / 3.0 - x2 * (0.2 - x2 * (1.0 / 7.0 - x2 * (1.0 / 9.0))))
                   : pnb_angle(cot, half_chord) - x;
  if (cot < 1e-6) return max(0.0, sin2 * cos_centre * pnb_arc_cosine(y) + pnb_angle(cot, half_chord));
  return max(0.0, sin2 * (cos_centre * pnb_arc_cosine(y) + x) + rest);
}
