// The glossy lobe: GGX (Walter et al. 2007; Heitz 2014) with Schlick's factor, times cos. x is to
// be multiplied by F0, y by 1.
vec2 pnb_ggx(float alpha2, float nv, float nl_signed, float vl) {
  float nl = max(nl_signed, 0.0), half2 = max(2.0 + 2.0 * vl, 1e-6);
  float nh2 = min((nv + nl) * (nv + nl) / half2, 1.0);
  float vh = sqrt(max(0.5 + 0.5 * vl, 0.0)), d = 1.0 - nh2 * (1.0 - alpha2);
  float smith = nl * sqrt(nv * nv * (1.0 - alpha2) + alpha2) +
                nv * sqrt(nl * nl * (1.0 - alpha2) + alpha2);
  float lobe = alpha2 * nl * 0.5 / (pnb_pi * d * d * smith);
  float m = 1.0 - vh, m2 = m * m, fresnel = m2 * m2 * m;
  return vec2(lobe * (1.0 - fresnel), lobe * fresnel);
}

float pnb_widened(float alpha, float solid_angle) {
  return min(1.0, alpha * alpha + 0.25 * solid_angle);
}

bool pnb_one_lobe(float solid_angle, float alpha) {
  return 0.25 * solid_angle < 1e-3 * alpha * alpha;
}

// Point i of 32 on the unit disk (Vogel's spiral).
vec2 pnb_spiral(int i) {
  float r = sqrt((float(i) + 0.5) / 32.0), phi = mod(float(i) * 2.39996323, 2.0 * pnb_pi);
  return r * vec2(cos(phi), sin(phi));
}

vec2 pnb_cone_glossy(vec3 n, vec3 v, float alpha, vec3 axis, float sin2) {
  float nv = max(dot(n, v), 1e-3);
  float one_minus_cos = sin2 / (1.0 + sqrt(1.0 - sin2)), whole = 2.0 * pnb_pi * one_minus_cos;
  if (pnb_one_lobe(whole, alpha))
    return pnb_ggx(pnb_widened(alpha, whole), nv, dot(n, axis), dot(v, axis)) * whole;
  vec3 mirrored = n * (2.0 * dot(n, v)) - v, aside = mirrored - axis * dot(mirrored, axis);
  vec3 u = dot(aside, aside) > 1e-10 ? normalize(aside) : pnb_frame(axis)[0], w = cross(axis, u);
  float share = whole / 32.0, wide = pnb_widened(alpha, share);
  vec2 sum = vec2(0.0);
  for (int i = pnb_zero; i < 32; ++i) {
    vec2 q = pnb_spiral(i);
    float away = dot(q, q) * one_minus_cos, k = sqrt(one_minus_cos * (2.0 - away));
    vec3 d = u * (k * q.x) + w * (k * q.y) + axis * (1.0 - away);
    sum += pnb_ggx(wide, nv, dot(n, d), dot(v, d));
  }
  return sum * share;
}

// Patch i of a flat light, a segment or a mesh: its place, its share of the area, its normal or the
// segment's direction.
vec3 pnb_light_patch(pnb_Light l, int i, out float area, out vec3 normal) {
  normal = l.type == 4 ? normalize(l.edge_u) : l.normal;
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6) {
    pnb_Faces f = pnb_faces_of(l);
    int at = f.patches + 2 * min(i, f.patch_count - 1);
    vec4 patch_ = pnb_light_texel(at);
    normal = pnb_light_texel(at + 1).xyz;
    area = i < f.patch_count ? patch_.w : 0.0;
    return patch_.xyz;
  }
#endif
  if (l.type == 2) {
    area = pnb_pi * l.radius * l.radius / 32.0;
    vec2 q = pnb_spiral(i) * l.radius;
    return l.position + pnb_frame(l.normal) * vec3(q, 0.0);
  }
  if (l.type == 4) {
    area = 2.0 * l.radius * length(l.edge_u) / 32.0;
    return l.position + l.edge_u * ((float(i) + 0.5) / 32.0 - 0.5);
  }
  int nu = clamp(int(floor(sqrt(32.0 * length(l.edge_u) / length(l.edge_v)) + 0.5)), 1, 32);
  int nv = max(1, 32 / nu);
  area = i < nu * nv ? length(cross(l.edge_u, l.edge_v)) / float(nu * nv) : 0.0;
  return l.position + l.edge_u * ((float(i % nu) + 0.5) / float(nu) - 0.5) +
         l.edge_v * ((float(i / nu) + 0.5) / float(nv) - 0.5);
}

// Solid angle of a patch, direction to it; bounded near it by the half space.
float pnb_patch_angle(pnb_Light l, vec3 p, int i, out vec3 direction) {
  float area;
  vec3 normal, to = pnb_light_patch(l, i, area, normal) - p;
  float d2 = max(dot(to, to), 1e-30), facing = -dot(to, normal);
  if (l.type == 4) facing = sqrt(max(0.0, d2 - facing * facing));
#ifdef PNB_MESH_LIGHTS
  if (l.type == 6 && pnb_faces_of(l).seen_within) facing = abs(facing);
#endif
  direction = to / sqrt(d2);
  return facing > 0.0 ? area * facing / (sqrt(d2) * (d2 + area / pnb_pi)) : 0.0;
}

vec2 pnb_patch_glossy(pnb_Light l, vec3 p, vec3 n, vec3 v, float alpha) {
  float nv = max(dot(n, v), 1e-3), whole = 0.0;
  float stretch =
      l.type == 4 ? max(1.0, length(l.edge_u) / (32.0 * 2.0 * l.radius)) : 1.0;
  vec3 middle = vec3(0.0), d;
  for (int i = pnb_zero; i < 32; ++i) {
    float a = pnb_patch_angle(l, p, i, d);
    if (dot(d, n) <= 0.0) a = 0.0;
    whole += a;
    middle += d * a;
  }
  if (whole <= 0.0) return vec2(0.0);
  vec3 mean = middle / whole;
  if (pnb_one_lobe(whole * stretch, alpha) && dot(mean, mean) > 0.9) {
    d = normalize(mean);
    return pnb_ggx(pnb_widened(alpha, whole), nv, dot(n, d), dot(v, d)) * whole;
  }
  vec2 sum = vec2(0.0);
  for (int i = pnb_zero; i < 32; ++i) {
    float a = pnb_patch_angle(l, p, i, d);
    if (a > 0.0) sum += pnb_ggx(pnb_widened(alpha, a * stretch), nv, dot(n, d), dot(v, d)) * a;
  }
  return sum;
}

// The lobe's light towards the viewer v per unit of emission.
vec2 pnb_glossy(pnb_Light l, vec3 p, vec3 n, vec3 v, float alpha) {
  vec3 to = l.position - p;
  float d2 = dot(to, to);
  vec3 axis = l.type == 5 ? l.normal : d2 > 0.0 ? to / sqrt(d2) : n;
  if (l.type == 0 || (l.type == 5 && l.sin2 < 1e-12)) {
    float s = clamp(-dot(l.normal, axis) * l.spot.x + l.spot.y, 0.0, 1.0);
    float strength = l.type == 5 ? 1.0 : s * s * (3.0 - 2.0 * s) / max(d2, 1e-12);
    return strength * pnb_ggx(alpha * alpha, max(dot(n, v), 1e-3), dot(n, axis), dot(v, axis));
  }
  if (l.type == 5) return pnb_cone_glossy(n, v, alpha, axis, l.sin2) / (pnb_pi * l.sin2);
  if (l.type == 1)
    return pnb_cone_glossy(n, v, alpha, axis, d2 > 0.0 ? min(1.0, l.radius * l.radius / d2) : 1.0);
  return pnb_patch_glossy(l, p, n, v, alpha);
}
