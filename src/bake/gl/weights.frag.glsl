#version 450
// Sums of what the samples give to each texel: see TexelWeights and, for
// FALLOFF, Falloff.

struct Weight {
  vec4 first;   // offset of texel (0, 0) from the sample; w: scale
  vec4 normal;  // w: k
};
layout(std140, binding = 0) uniform Weights { Weight weights[32]; };  // zero: no sample
uniform usampler2DArray hidden;  // a bit a sample
uniform int layer;
uniform vec3 step_x, step_y;
layout(location = 0) out vec4 sums;  // of the samples that nothing hides, of all

float weight_of(Weight s, vec3 d) {
  float r2 = max(dot(d, d), 1e-12), a = dot(s.normal.xyz, d);
  float scale = s.first.w, k = s.normal.w;
#if FALLOFF == 0
  return scale * max(0.0, a) / (r2 * (r2 + k));
#elif FALLOFF == 1
  return scale * abs(a) / (r2 * (r2 + k));
#elif FALLOFF == 2
  return scale * sqrt(max(0.0, r2 - a * a)) / (r2 * (r2 + k));
#elif FALLOFF == 3
  return scale / (r2 * sqrt(r2));
#elif FALLOFF == 4
  return scale * max(0.0, a) / (r2 * sqrt(r2));
#elif FALLOFF == 5
  return a > 0.0 ? scale : 0.0;
#else
  return scale;
#endif
}

// Unrolled: drivers on processors read what has a constant index once for many texels.
#define ADD(i) \
  weight = weight_of(weights[i], weights[i].first.xyz + offset); \
  whole += weight; \
  lit += (word >> i & 1u) == 0u ? weight : 0.0;
#define ADD_8(i) \
  ADD((i)) ADD((i + 1)) ADD((i + 2)) ADD((i + 3)) ADD((i + 4)) ADD((i + 5)) ADD((i + 6)) ADD((i + 7))

void main() {
  vec2 at = floor(gl_FragCoord.xy);
  vec3 offset = step_x * at.x + step_y * at.y;
  uint word = texelFetch(hidden, ivec3(ivec2(at), layer), 0).x;
  float lit = 0.0, whole = 0.0, weight;
  ADD_8(0) ADD_8(8) ADD_8(16) ADD_8(24)
  sums = vec4(lit, whole, 0.0, 0.0);
}
