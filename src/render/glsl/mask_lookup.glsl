
// Cut-out textures, as src/geometry/alpha_mask.h has them.
uniform highp sampler2D pnb_masks;  // distances to opaque texels, one behind the other

// wrap: 0 repeat, 1 clamp, 2 mirror.
float pnb_mask(int first, ivec2 size, ivec2 wrap, vec2 uv) {
  for (int axis = 0; axis < 2; ++axis)
    uv[axis] = wrap[axis] == 0   ? fract(uv[axis])
               : wrap[axis] == 1 ? clamp(uv[axis], 0.0, 1.0)
                                 : 1.0 - abs(uv[axis] - 2.0 * floor(0.5 * uv[axis]) - 1.0);
  vec2 x = uv * vec2(size) - 0.5, part = fract(x);
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 tap = ivec2(k & 1, k >> 1), at = ivec2(floor(x)) + tap;
    at = ivec2(wrap.x == 0 ? (at.x + size.x) % size.x : clamp(at.x, 0, size.x - 1),
               wrap.y == 0 ? (at.y + size.y) % size.y : clamp(at.y, 0, size.y - 1));
    int i = first + at.y * size.x + at.x;
    vec2 weight = mix(1.0 - part, part, vec2(tap));
    sum += weight.x * weight.y * texelFetch(pnb_masks, ivec2(i >> 2 & 4095, i >> 14), 0)[i & 3];
  }
  return sum;
}
