// The field's surfaces.
uniform vec3 pnb_low, pnb_high;  // nothing is looked for outside this box

bool pnb_unfinished = false;  // a ray ran out of steps
int pnb_steps = 0;            // of rays
float pnb_last = 0.0;         // the field where pnb_trace ended

const int pnb_most_steps = 1024;

// Where the ray enters and leaves the box.
vec2 pnb_span(vec3 ro, vec3 rd) {
  vec3 d = mix(rd, vec3(1e-20), lessThan(abs(rd), vec3(1e-20)));
  vec3 a = (pnb_low - ro) / d, b = (pnb_high - ro) / d, lo = min(a, b), hi = max(a, b);
  return vec2(max(max(lo.x, lo.y), max(lo.z, 0.0)), min(hi.x, min(hi.y, hi.z)));
}

// Distance to the first surface along the ray; -1 if there is none.
float pnb_trace(vec3 ro, vec3 rd) {
  vec2 span = pnb_span(ro, rd);
  float t = span.x;
  for (int i = 0; i < pnb_most_steps; ++i) {
    if (t > span.y) return -1.0;
    pnb_last = pnb_map(ro + rd * t);
    ++pnb_steps;
    if (pnb_last <= 1e-5 * t) return t;
    t += pnb_last;
  }
  // Along a surface for a thousand steps: it is seen if it is within a pixel or so.
  if (pnb_last < 1e-3 * t) return t;
  pnb_unfinished = true;
  return -1.0;
}

// Unit normal by central differences over e.
vec3 pnb_normal(vec3 p, float e) {
  vec3 n = vec3(0.0);
  for (int i = pnb_zero; i < 3; ++i) {
    vec3 d = vec3(i == 0, i == 1, i == 2);
    for (int s = pnb_zero; s < 2; ++s) {
      float side = s == 0 ? 1.0 : -1.0;
      n += side * d * pnb_map(p + side * e * d);
    }
  }
  float size = length(n);
  return size > 0.0 ? n / size : vec3(0.0, 1.0, 0.0);
}

// How far from its place a point may be by the rounding of its coordinates and of the field.
float pnb_epsilon(vec3 p) {
  vec3 a = abs(p);
  return 1e-5 * max(max(a.x, a.y), max(a.z, 1e-3 * length(pnb_high - pnb_low)));
}

// 1 if nothing stands between the surface point p and the distance maxt along rd.
float pnb_visible(vec3 p, vec3 n, vec3 rd, float maxt) {
  float e = pnb_epsilon(p), t = e;
  vec3 ro = p + n * (2.0 * e);
  maxt = min(maxt, pnb_span(ro, rd).y);
  for (int i = 0; i < pnb_most_steps; ++i) {
    if (t >= maxt) return 1.0;
    float h = pnb_map(ro + rd * t);
    ++pnb_steps;
    if (h < e) return 0.0;
    t += h;
  }
  pnb_unfinished = true;
  return 0.0;
}

// What a person is told of this pixel, as one number: 1 the eye is in a solid, 2 the driver ended
// loops, 4 a march ran out of steps; and 8 for every step.
float pnb_notes(bool inside) {
  bool unfinished = pnb_unfinished || penumbra_out_of_steps;
  return (inside ? 1.0 : 0.0) + (pnb_loops_are_cut() ? 2.0 : 0.0) + (unfinished ? 4.0 : 0.0) +
         8.0 * float(pnb_steps + penumbra_steps_taken);
}
