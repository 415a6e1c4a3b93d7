
// What the ray meets, with all its light.
vec3 pnb_shade(vec3 p, vec3 n, vec3 v, pnb_Material m) {
  vec3 color = m.emission + pnb_ambient * (m.diffuse + m.specular);
  for (int i = pnb_zero; i < pnb_light_count; ++i) {
    pnb_Light l = pnb_light_at(i);
    float e = pnb_irradiance(l, p, n);
    vec3 reflected = m.diffuse * (e / pnb_pi);
#ifdef PNB_GLOSSY
    if (max(m.specular.x, max(m.specular.y, m.specular.z)) > 0.0) {
      vec2 g = pnb_glossy(l, p, n, v, m.alpha);
      reflected += m.specular * g.x + g.y;
    }
#endif
    if (max(reflected.x, max(reflected.y, reflected.z)) > 0.0)
      color += l.emission * reflected * pnb_fraction(l, p, n);
  }
  return color;
}

// Radiance along a ray, mirrors followed.
vec3 pnb_radiance(vec3 ro, vec3 rd) {
  vec3 color = vec3(0.0), throughput = vec3(1.0);
  float way = 0.0;
  for (int i = pnb_zero; i <= pnb_mirrors; ++i) {
    float t = pnb_trace(ro, rd);
    if (t < 0.0) return color + throughput * pnb_background;
    pnb_Met met = pnb_met(ro, rd, t, way, 0.0);
    way += met.t;
    color += throughput * pnb_shade(met.position, met.normal, -rd, met.material);
    throughput *= met.material.mirror;
    if (max(throughput.x, max(throughput.y, throughput.z)) <= 1.0 / 500.0) break;
    ro = met.position + met.facing * (4.0 * pnb_epsilon(met.position));
    rd = pnb_mirrored(rd, met.normal, met.facing);
  }
  return color;
}

vec3 pnb_srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  vec3 sum = vec3(0.0);
  for (int i = pnb_zero; i < pnb_samples; ++i) {
    vec2 q = (2.0 * (fragCoord + pnb_sample_at(i)) - iResolution.xy) / iResolution.y;
    vec3 aside = pnb_right * q.x + pnb_up * q.y;
    sum += PNB_RAY;
  }
  fragColor = vec4(pnb_srgb(exp2(pnb_exposure) * sum / float(pnb_samples)), 1.0);
}
