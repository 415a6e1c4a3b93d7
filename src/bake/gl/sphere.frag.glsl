#version 450
// Texels from which the segment to the sample meets the surface of a sphere, among those that its
// box covers.
flat in vec4 of_sphere;  // centre and radius; negative where the receiver cuts it
flat in vec4 of_sample;  // world; w: 1, or 0 of a direction
flat in uint bit;
uniform vec3 origin, step_x, step_y;  // of the tile
layout(location = 0) out uint bits;

void main() {
  vec2 at = floor(gl_FragCoord.xy);
  vec3 texel = origin + step_x * at.x + step_y * at.y;
  bool far = of_sample.w == 0.0;
  float radius2 = of_sphere.w * of_sphere.w;
  vec3 to_center = of_sphere.xyz - texel;
  vec3 to_sample = far ? of_sample.xyz : of_sample.xyz - texel;
  vec3 from_sample = of_sphere.xyz - of_sample.xyz;
  bool holds_sample = !far && dot(from_sample, from_sample) <= radius2;
  vec3 across = cross(to_sample, to_center);
  bool meets = dot(across, across) <= dot(to_sample, to_sample) * radius2 &&
               (far || dot(to_sample, from_sample) < 0.0);
  if (!meets && !holds_sample) discard;
  bool cut = of_sphere.w < 0.0;
  bool inside = dot(to_center, to_center) < radius2;
  if (cut && !(inside ? !holds_sample : dot(to_center, to_sample) > 0.0)) discard;
  bits = bit;
}
