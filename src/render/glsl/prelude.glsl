precision highp float;
precision highp int;
precision highp sampler2D;

uniform vec3 iResolution;
uniform float iTime, iTimeDelta, iFrameRate;
uniform int iFrame;
uniform vec4 iMouse, iDate;

uniform vec2 pnb_tile;  // lower left pixel of what is drawn now
uniform vec2 pnb_size;  // of the whole picture, pixels
uniform int pnb_zero;   // 0: keeps compilers from unrolling

#define pnb_FragCoord (gl_FragCoord + vec4(pnb_tile, 0.0, 0.0))

// Some drivers end all loops of a pixel after a number of turns and go on with what there is then.
bool pnb_loops_are_cut() {
  int n = 1;
  for (int i = pnb_zero; i < 6; ++i) n = n * 3 + i;
  return n != 908;
}
