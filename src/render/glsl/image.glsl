// A shader's own picture, as Shadertoy shows it.
uniform vec2 pnb_in_pixel;  // in the pixel, from its lower left corner

layout(location = 0) out vec4 pnb_out0;  // its colour, notes

void main() {
  vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
  mainImage(color, floor(gl_FragCoord.xy) + pnb_tile + pnb_in_pixel);
  pnb_out0 = vec4(color.rgb, pnb_loops_are_cut() ? 5.0 : 1.0);
}
