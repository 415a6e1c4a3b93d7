// Soft shadows of distance fields, as published: what part of a light is seen along one march.
//
//   Inigo Quilez: Soft Shadows in Raymarched SDFs. iquilezles.org/articles/rmshadows, 2010; with
//   Sebastian Aaltonen's improvement (GDC 2018) and the inner penumbra after nurof3n.
//   The "blog" variant: the same idea found independently, its ratio taken after the step.
//
// Take it home: paste it below your `float map(vec3 p)` (distance to the scene, negative inside).
// GLSL ES 3.00, so it runs on Shadertoy as it is. All functions take
//   ro        the shaded point
//   rd        unit direction from it to the light's centre
//   mint      where the march begins, 0.01 say: far enough not to meet the point's own surface
//   maxt      the light's distance; for a sun as far as the scene reaches
//   w         the light's size: the tangent of half the angle that it fills, 1/k of the article
// and return the visible fraction in [0, 1]. A light of no size (w = 0) gives hard shadows.
//
// The constants 0.001, 0.0001, 0.005, 0.50 and -1 are the publications' own, in metres: scale your
// scene to them. What was not published stands apart and is called a guard:
//   - penumbra_size: w is at least 1e-6, so that nothing is divided by 0;
//   - penumbra_improved: the estimate needs the step before to have been h long and is 0/0 over a
//     plane that the light stands straight above; there the classic ratio counts;
//   - a march that reaches neither light nor occluder in PENUMBRA_STEPS steps has not seen all of
//     its way: it says so in penumbra_out_of_steps and returns what it has found.
//
// Known failures: all take one occluder into account and sample the clearance at the steps of the
// march. classic, blog and improved have the outer half of the penumbra alone, so the umbra is too
// large; classic and blog show bands behind sharp corners; inner and abs leak light through what
// is thinner than the penumbra.
#ifndef PENUMBRA_MAP
#define PENUMBRA_MAP map
#endif
#ifndef PENUMBRA_STEPS
#define PENUMBRA_STEPS 256
#endif

bool penumbra_out_of_steps = false;  // set to true by a march that ran out of steps
int penumbra_steps_taken = 0;        // of all marches so far

float penumbra_size(float w) { return max(w, 1e-6); }

// The plain march to the light's centre: 0 or 1.
float penumbra_shadow_hard(vec3 ro, vec3 rd, float mint, float maxt) {
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt; i++) {
    float h = PENUMBRA_MAP(ro + rd * t);
    penumbra_steps_taken++;
    if (h < 0.001) return 0.0;
    t += h;
  }
  if (t < maxt) penumbra_out_of_steps = true;
  return 1.0;
}

// The ratio of clearance to distance, least of all steps; w divides the least of h / t.
float penumbra_shadow_classic(vec3 ro, vec3 rd, float mint, float maxt, float w) {
  float res = 1e20;
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt; i++) {
    float h = PENUMBRA_MAP(ro + rd * t);
    penumbra_steps_taken++;
    if (h < 0.001) return 0.0;
    res = min(res, h / t);
    t += h;
  }
  if (t < maxt) penumbra_out_of_steps = true;
  return min(res / penumbra_size(w), 1.0);
}

// The blog's order: step first, then the ratio. It marches up to 150; never beyond the light here.
float penumbra_shadow_blog(vec3 ro, vec3 rd, float mint, float maxt, float w) {
  w = penumbra_size(w);
  maxt = min(maxt, 150.0);
  float res = 1.0;
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt; i++) {
    float h = PENUMBRA_MAP(ro + rd * t);
    penumbra_steps_taken++;
    t += h;
    res = min(res, h / (w * t));
    if (h < 0.0001) return 0.0;
  }
  if (t < maxt) penumbra_out_of_steps = true;
  return res;
}

// Aaltonen: the nearest miss lies where the spheres of this step and the last one meet,
// y = h h / 2ph before the present point and d = sqrt(h h - y y) from the ray; the least of
// d / (t - y) counts.
// Here as its square, ph brought out of both: h h (4 ph ph - h h) / (2 ph t - h h)^2.
float penumbra_shadow_improved(vec3 ro, vec3 rd, float mint, float maxt, float w) {
  float res2 = 1e20;
  float ph2 = 0.0;  // twice the step before; 0: none
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt; i++) {
    float h = PENUMBRA_MAP(ro + rd * t);
    penumbra_steps_taken++;
    if (h < 0.001) return 0.0;
    float hh = h * h;
    float to_miss = ph2 * t - hh;
    // Guard: no such place (the root of a negative number), or behind the start (0/0 over a plane).
    bool meet = h < ph2 && to_miss > 0.0;
    float above = hh * (meet ? ph2 * ph2 - hh : 1.0);
    float below = meet ? to_miss : t;
    res2 = min(res2, above / (below * below));
    ph2 = 2.0 * h;
    t += h;
  }
  if (t < maxt) penumbra_out_of_steps = true;
  return min(sqrt(res2) / penumbra_size(w), 1.0);
}

float penumbra_inner_profile(float res) {
  res = max(res, -1.0);
  return 0.25 * (1.0 + res) * (1.0 + res) * (2.0 - res);
}

// The march goes on inside: near hits darken as near misses do.
float penumbra_shadow_inner(vec3 ro, vec3 rd, float mint, float maxt, float w) {
  w = penumbra_size(w);
  float res = w;  // w times the published one: the least of h / t
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt && res >= -w; i++) {
    float h = PENUMBRA_MAP(ro + t * rd);
    penumbra_steps_taken++;
    res = min(res, h / t);
    t += clamp(h, 0.005, 0.50);
  }
  if (t < maxt && res >= -w) penumbra_out_of_steps = true;
  return penumbra_inner_profile(res / w);
}

// The same with the step that the article mentions first: the size of h.
float penumbra_shadow_abs(vec3 ro, vec3 rd, float mint, float maxt, float w) {
  w = penumbra_size(w);
  float res = w;
  float t = mint;
  for (int i = 0; i < PENUMBRA_STEPS && t < maxt && res >= -w; i++) {
    float h = PENUMBRA_MAP(ro + t * rd);
    penumbra_steps_taken++;
    res = min(res, h / t);
    t += abs(h);
  }
  if (t < maxt && res >= -w) penumbra_out_of_steps = true;
  return penumbra_inner_profile(res / w);
}
