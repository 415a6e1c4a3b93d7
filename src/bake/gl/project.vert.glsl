#version 450
// Occluders as each of some samples sees them from the tile: Heckbert and Herf (1997), section 3.3.

struct Sample {
  vec4 origin;  // w: the least w that is drawn
  vec4 x, y, w;  // rows of the matrix; w: constants
  vec4 sample_at;  // world; w: 1, or 0 of a direction
  uvec4 bit;  // x: of the word
};
layout(std140, binding = 0) uniform Samples { Sample samples[32]; };
uniform vec2 size;  // texels

layout(location = 0) in vec3 position;  // world
#ifdef SPHERES
layout(location = 1) in vec4 sphere;  // centre and radius; negative where the receiver cuts it
flat out vec4 of_sphere;
flat out vec4 of_sample;
#endif
flat out uint bit;

void main() {
  Sample s = samples[gl_InstanceID];
  vec3 q = position - s.origin.xyz;
  float w = dot(s.w.xyz, q) + s.w.w;
  // Texel i is centred at x = i w; a pixel at i + 1/2.
  vec2 at = vec2(dot(s.x.xyz, q) + s.x.w, dot(s.y.xyz, q) + s.y.w) + 0.5 * w;
  // z >= -w is where w is least.
  gl_Position = vec4(2.0 * at / size - w, w - 2.0 * s.origin.w, w);
  bit = s.bit.x;
#ifdef SPHERES
  of_sphere = sphere, of_sample = s.sample_at;
#endif
}
