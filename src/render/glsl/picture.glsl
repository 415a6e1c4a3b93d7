// A picture: what the pixel's ray meets, and the light there.
uniform vec3 pnb_eye, pnb_forward, pnb_aside, pnb_step_x, pnb_step_y;
uniform int pnb_orthographic;
uniform vec2 pnb_beam;      // a pixel's: its width at the eye, and how much that grows a metre
uniform vec2 pnb_in_pixel;  // in the pixel, from its top left corner
uniform vec3 pnb_ambient, pnb_background;
uniform int pnb_base;          // 1: with ambient light, emission and background
uniform int pnb_ask_all;       // 1: visibility even where the light brings nothing
uniform int pnb_mirrors;       // reflections followed
uniform int pnb_generation;    // the reflection whose lights are wanted; -1: all
uniform int pnb_light_count;
uniform int pnb_unlit_too;     // 1: layer 3 is what surfaces show without lights

layout(location = 0) out vec4 pnb_out0;  // radiance, notes; by points: sum seen, and of all
#if defined(PNB_LAYERS) || defined(PNB_BY_POINTS)
layout(location = 1) out vec4 pnb_out1;  // depth and normal; by points: the glossy sums
layout(location = 2) out vec4 pnb_out2;  // visible fractions of four lights
layout(location = 3) out vec4 pnb_out3;  // notes, 1 = something is met, 1 = it reflects, steps
#endif

vec4 pnb_sum0 = vec4(0.0), pnb_sum1 = vec4(0.0), pnb_seen = vec4(1.0);
bool pnb_reflects = false;  // what is met first has a diffuse or glossy share
bool pnb_inside = false;  // the eye is in a solid
int pnb_first_steps = 0;  // of the marches from what is met first

struct pnb_Point {
  vec3 position, normal, to_viewer, facing;
  pnb_Material material;
};

float pnb_brightness(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

#ifdef PNB_BY_POINTS
// Sums over the light's points: diffuse seen and all, glossy seen and all; returns how many are
// seen.
float pnb_by_points(pnb_Light l, pnb_Point q, out vec4 sums) {
  float seen = 0.0;
  sums = vec4(0.0);
  vec4 pattern = texelFetch(pnb_patterns, ivec2(gl_FragCoord.xy), 0);
  float seen_area = pnb_seen_area(l, q.position);
  for (int i = pnb_first_point; i < pnb_last_point; ++i) {
    vec3 d;
    float reach, weight;
    pnb_light_point(l, q.position, pattern, i, seen_area, d, reach, weight);
    float nl = dot(q.normal, d);
    if (nl <= 0.0) continue;
    float visible = pnb_visible(q.position, q.normal, d, reach, l.own);
    seen += visible;
    sums.xy += weight * nl * vec2(visible, 1.0);
#ifdef PNB_GLOSSY
    vec2 g = pnb_ggx(pnb_widened(q.material.alpha, weight / float(pnb_point_total)),
                     max(dot(q.normal, q.to_viewer), 1e-3), nl, dot(q.to_viewer, d));
    sums.zw += weight * (pnb_brightness(q.material.specular) * g.x + g.y) * vec2(visible, 1.0);
#endif
  }
  return seen / float(pnb_point_total);
}
#endif

void pnb_add_light(int i, pnb_Point q, vec3 throughput, bool first) {
  pnb_Light l = pnb_light_at(i);
  pnb_Material m = q.material;
  bool is_diffuse = max(m.diffuse.x, max(m.diffuse.y, m.diffuse.z)) > 0.0;
  float e = is_diffuse ? pnb_irradiance(l, q.position, q.normal) : 0.0;
  vec2 g = vec2(0.0);
#ifdef PNB_GLOSSY
  bool is_glossy = max(m.specular.x, max(m.specular.y, m.specular.z)) > 0.0;
  if (is_glossy && (e > 0.0 || !is_diffuse))
    g = pnb_glossy(l, q.position, q.normal, q.to_viewer, m.alpha);
#endif
  bool ask = e > 0.0 || g.x > 0.0 || g.y > 0.0;
  if (!ask && !(first && pnb_ask_all == 1)) return;
  vec3 diffuse = throughput * l.emission * m.diffuse * (e / pnb_pi);
  vec3 glossy = throughput * l.emission * (m.specular * g.x + g.y);
#ifdef PNB_BY_POINTS
  vec4 sums;
  float seen = pnb_by_points(l, q, sums);
  pnb_sum0 += vec4(diffuse * sums.x, sums.y);
  pnb_sum1 += vec4(glossy * sums.z, sums.w);
#else
  float seen = pnb_fraction(l, q.position, q.normal);
  pnb_sum0.rgb += (diffuse + glossy) * seen;
#endif
  if (first) pnb_seen[i] = seen, pnb_first_steps = penumbra_steps_taken;
}

// What the ray meets is shaded; false if it meets nothing.
bool pnb_meet(vec3 ro, vec3 rd, int generation, inout float way, vec3 throughput,
              out pnb_Point q) {
  float t = pnb_trace(ro, rd);
  bool base = pnb_base == 1;
  if (t < 0.0) {
    if (base) pnb_sum0.rgb += throughput * pnb_background;
    return false;
  }
  if (generation == 0 && t <= 0.0) {
    pnb_inside = true;
    return false;
  }
  pnb_Met met = pnb_met(ro, rd, t, way, pnb_beam.x + pnb_beam.y * (way + t));
  q = pnb_Point(met.position, met.normal, -rd, met.facing, met.material);
  t = met.t;
  if (base && generation == 0 && pnb_unlit_too == 0) pnb_sum1 = vec4(t, q.normal);
  way += t;
  vec3 share = max(q.material.diffuse, q.material.specular);
  if (generation == 0) pnb_reflects = max(share.x, max(share.y, share.z)) > 0.0;
  vec3 unlit = pnb_ambient * (q.material.diffuse + q.material.specular);
  if (base && pnb_unlit_too == 1) {
    pnb_sum1.rgb = unlit;
    pnb_sum1.w = pnb_brightness(q.material.emission);
  }
  if (base) pnb_sum0.rgb += throughput * (unlit + q.material.emission);
  if (pnb_generation >= 0 && generation != pnb_generation) return true;
  if (generation == 0) pnb_seen = vec4(0.0);
  for (int i = 0; i < pnb_light_count; ++i)
    pnb_add_light(i, q, throughput, generation == 0);
  return true;
}

void main() {
  vec2 pixel = floor(gl_FragCoord.xy) + pnb_tile;
  vec2 xy = vec2(pixel.x, pnb_size.y - 1.0 - pixel.y) + pnb_in_pixel;
  vec3 aside = pnb_aside + pnb_step_x * xy.x + pnb_step_y * xy.y;
  vec3 ro = pnb_orthographic == 1 ? pnb_eye + aside : pnb_eye;
  vec3 rd = pnb_orthographic == 1 ? pnb_forward : normalize(pnb_forward + aside);
  vec3 throughput = vec3(1.0);
  float way = 0.0;
  bool met = false;
  pnb_Point q;
  for (int generation = 0; generation <= pnb_mirrors; ++generation) {
    if (!pnb_meet(ro, rd, generation, way, throughput, q)) break;
    met = true;
    throughput *= q.material.mirror;
    if (max(throughput.x, max(throughput.y, throughput.z)) <= 1.0 / 500.0) break;
    ro = q.position + q.facing * (4.0 * pnb_epsilon(q.position));
    rd = pnb_mirrored(rd, q.normal, q.facing);
  }
  if (pnb_inside) pnb_sum0 = vec4(0.0);
  float notes = pnb_notes(pnb_inside);
  pnb_out0 = pnb_sum0;
#ifndef PNB_BY_POINTS
  pnb_out0.w = notes;
#endif
#if defined(PNB_LAYERS) || defined(PNB_BY_POINTS)
  pnb_out1 = pnb_sum1;
  pnb_out2 = pnb_seen;
  pnb_out3 = vec4(notes, met, pnb_reflects, pnb_first_steps);
#endif
}
