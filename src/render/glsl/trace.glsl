// The field's surfaces.
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

// Where a ray begins and ends.
vec2 pnb_way(vec3 ro, vec3 rd) {
  return pnb_sight > 0.0 ? vec2(0.0, pnb_sight) : pnb_span(ro, rd);
}

// Distance to the first surface along the ray; -1 if there is none.
float pnb_trace(vec3 ro, vec3 rd) {
  vec2 inside = pnb_way(ro, rd);
  float t = inside.x;
  for (int i = 0; i < pnb_most_steps; ++i) {
    if (t > inside.y) return -1.0;
    pnb_last = pnb_surface(ro + rd * t);
    ++pnb_steps;
    if (pnb_last <= 1e-5 * t) return t;
    t += pnb_last;
  }
  // Along a surface for a thousand steps: it is seen if it is within a pixel or so.
  if (pnb_last < 1e-3 * t) return t;
  pnb_unfinished = true;
  return -1.0;
}

// Unit normal at p by central differences over e. On a sheet both sides look alike, and rounding
// makes any direction of that: where the slope is below 1, it is taken a little before p on the ray
// too, and the steeper counts.
vec3 pnb_normal(vec3 p, vec3 rd, float e) {
  vec3 n = vec3(0.0), at_p = vec3(0.0);
  for (int i = pnb_zero; i < 12; ++i) {
    if (i == 6) {
      if (length(n) > 1.9 * e) break;
      p -= 4.0 * e * rd;
      at_p = n;
      n = vec3(0.0);
    }
    int axis = i % 3;
    vec3 d = vec3(axis == 0, axis == 1, axis == 2);
    float side = i % 6 < 3 ? 1.0 : -1.0;
    n += side * d * pnb_signed(p + side * e * d);
  }
  if (length(n) < 1.1 * length(at_p)) n = at_p;
  float size = length(n);
  return size > 0.0 ? n / size : -rd;
}

// How far from its place a point may be by the rounding of its coordinates and of the field.
float pnb_epsilon(vec3 p) {
  vec3 a = abs(p);
  return 1e-5 * max(max(a.x, a.y), max(a.z, 1e-3 * length(pnb_high - pnb_low)));
}

// 1 if nothing but the instance `own` stands between the surface point p and the distance maxt
// along rd.
float pnb_visible(vec3 p, vec3 n, vec3 rd, float maxt, int own) {
  float e = pnb_epsilon(p), t = e;
  vec3 ro = p + n * (2.0 * e);
  maxt = min(maxt, pnb_way(ro, rd).y);
  pnb_own = own;
  float seen = -1.0;
  for (int i = 0; i < pnb_most_steps && seen < 0.0; ++i) {
    if (t >= maxt) {
      seen = 1.0;
      break;
    }
    float h = pnb_surface(ro + rd * t);
    ++pnb_steps;
    if (h < e) seen = 0.0;
    t += h;
  }
  pnb_own = -1;
  if (seen < 0.0) pnb_unfinished = true;
  return max(seen, 0.0);
}
