// A picture of its own: rings that spread with iTime. Shadertoy's mainImage, run as it is.
//   penumbra render scenes/rings.glsl -o rings.png --time 1
void mainImage(out vec4 fragColor, in vec2 fragCoord) {
  vec2 p = (2.0 * fragCoord - iResolution.xy) / iResolution.y;
  float d = length(p), ring = 0.5 + 0.5 * cos(20.0 * d - 3.0 * iTime);
  vec3 tint = mix(vec3(0.05, 0.1, 0.3), vec3(1.0, 0.8, 0.5), ring);
  fragColor = vec4(tint * exp(-0.7 * d), 1.0);
}
