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

#ifdef PNB_MASKS
// True where the ray meets a hole of a cut-out texture, `most` or less from p.
bool pnb_is_hole(vec3 p, vec3 rd, float most) {
  pnb_Facet f = pnb_facet(p, rd, most);
  return f.record >= 0 && most <= abs(pnb_shapes(p)) && pnb_is_cut_out(f);
}
#endif

// Distance to the first surface along the ray, from t on; -1 if there is none.
float pnb_next(vec3 ro, vec3 rd, float t, float end) {
  for (int i = 0; i < pnb_most_steps; ++i) {
    if (t > end) return -1.0;
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

// The same from the eye or a mirror on; -1 if there is none.
float pnb_trace(vec3 ro, vec3 rd) {
  vec2 inside = pnb_way(ro, rd);
  float t = pnb_next(ro, rd, inside.x, inside.y);
#ifdef PNB_MASKS
  for (int i = 0; i < pnb_most_steps && t > 0.0; ++i) {
    if (!pnb_is_hole(ro + rd * t, rd, 4e-5 * t)) break;
    t = pnb_next(ro, rd, 1.00003 * t, inside.y);
  }
#endif
  return t;
}

// Differences over e round p: central ones, or by a tetrahedron (`wide`); their mean last, which is
// the field at p where that is flat.
vec4 pnb_differences(vec3 p, float e, bool wide) {
  vec4 n = vec4(0.0);
  int count = wide ? 4 : 6;
  for (int k = pnb_zero; k < count; ++k) {
    int axis = k % 3;
    vec3 d = vec3(axis == 0, axis == 1, axis == 2) * (k < 3 ? 1.0 : -1.0);
    if (wide) d = vec3(k == 0 || k == 3, k > 1, k % 2) * 2.0 - 1.0;
    n += vec4(d, 1.0 / float(count)) * pnb_signed(p + e * d);
  }
  return n;
}

// Unit normal at p by differences over e; on an sdf object, whose rounding may be great, wider ones,
// and closer again where they tell of a bend, as beside an edge. A second time a little before p on
// the ray where that is needed: on a sheet both sides look alike, and rounding makes any direction
// of that (the slope is below 1; the steeper counts); differences reach round an edge, to a side
// that faces away.
vec3 pnb_normal(vec3 p, vec3 rd, float e) {
  bool wide = pnb_is_rounded(p);
  if (wide) e = 1e-3 * max(max(abs(p.x), max(abs(p.y), abs(p.z))), 1e-3);
  vec3 n = vec3(0.0), at_p = vec3(0.0);
  float reach = e;
  for (int i = pnb_zero; i < 3; ++i) {
    vec4 all = pnb_differences(p, reach, wide);
    n = all.xyz;
    if (at_p != vec3(0.0)) break;
    if (wide && reach == e && abs(all.w - pnb_last) > 0.02 * e) {
      reach = e / 16.0;
      continue;
    }
    if (wide ? dot(n, rd) < 0.0 : length(n) > 1.9 * e) break;
    p -= 4.0 * e * rd;
    at_p = n;
    reach = e;
  }
  if (wide ? dot(n, rd) >= 0.0 && at_p != vec3(0.0) : length(n) < 1.1 * length(at_p)) n = at_p;
  float size = length(n);
  return size > 0.0 ? n / size : -rd;
}

// How far from its place a point may be by the rounding of its coordinates and of the field.
float pnb_epsilon(vec3 p) {
  vec3 a = abs(p);
  return 1e-5 * max(max(a.x, a.y), max(a.z, 1e-3 * length(pnb_high - pnb_low)));
}

// Where something nearer than e is, from t on; maxt if nothing is before that.
float pnb_obstacle(vec3 ro, vec3 rd, float t, float maxt, float e) {
  for (int i = 0; i < pnb_most_steps; ++i) {
    if (t >= maxt) return maxt;
    float h = pnb_surface(ro + rd * t);
    ++pnb_steps;
    if (h < e) return t;
    t += h;
  }
  pnb_unfinished = true;
  return t;
}

// 1 if nothing but the instance `own` stands between the surface point p and the distance maxt
// along rd.
float pnb_visible(vec3 p, vec3 n, vec3 rd, float maxt, int own) {
  float e = pnb_epsilon(p);
  vec3 ro = p + n * (2.0 * e);
  maxt = min(maxt, pnb_way(ro, rd).y);
  pnb_left_out = own;
  float t = pnb_obstacle(ro, rd, e, maxt, e);
#ifdef PNB_MASKS
  for (int i = 0; i < pnb_most_steps && t < maxt; ++i) {
    if (!pnb_is_hole(ro + rd * t, rd, 4.0 * e)) break;
    t = pnb_obstacle(ro, rd, t + 3.0 * e, maxt, e);
  }
#endif
  pnb_left_out = -1;
  return t < maxt ? 0.0 : 1.0;
}
