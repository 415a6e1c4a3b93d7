
// Textures, as src/image/texture_sampler.h has them.
uniform highp sampler2D pnb_images;  // bytes of all levels of all images, one behind the other

vec4 pnb_image_texel(int first, ivec2 size, ivec2 at, bool srgb) {
  int i = first + at.y * size.x + at.x;
  vec4 c = texelFetch(pnb_images, ivec2(i & 4095, i >> 12), 0);
  vec3 linear = mix(c.rgb / 12.92, pow((c.rgb + 0.055) / 1.055, vec3(2.4)),
                    greaterThan(c.rgb, vec3(0.04045)));
  return srgb ? vec4(linear, c.a) : c;
}

// wrap: 0 repeat, 1 clamp, 2 mirror.
int pnb_wrapped(int i, int size, int wrap) {
  if (wrap == 1) return clamp(i, 0, size - 1);
  int period = wrap == 2 ? 2 * size : size, turn = (i % period + period) % period;
  return turn < size ? turn : 2 * size - 1 - turn;
}

vec4 pnb_image_level(int first, ivec2 size, ivec2 wrap, bool nearest, bool srgb, vec2 uv) {
  for (int axis = 0; axis < 2; ++axis)
    uv[axis] = wrap[axis] == 1   ? clamp(uv[axis], -1.0, 2.0)
               : wrap[axis] == 2 ? uv[axis] - 2.0 * floor(0.5 * uv[axis])
                                 : fract(uv[axis]);
  vec2 x = uv * vec2(size) - (nearest ? 0.0 : 0.5), part = nearest ? vec2(0.0) : fract(x);
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 4; ++k) {
    ivec2 tap = ivec2(k & 1, k >> 1), at = ivec2(floor(x)) + tap;
    vec2 weight = mix(1.0 - part, part, vec2(tap));
    at = ivec2(pnb_wrapped(at.x, size.x, wrap.x), pnb_wrapped(at.y, size.y, wrap.y));
    sum += weight.x * weight.y * pnb_image_texel(first, size, at, srgb);
  }
  return sum;
}

// At uv of the image, over a footprint so many texels wide.
vec4 pnb_image(int first, ivec2 size, ivec2 wrap, bool nearest, bool srgb, vec2 uv, float texels) {
  int last = 0;
  for (int side = max(size.x, size.y); side > 1; side >>= 1) ++last;
  if (texels <= 1.0 || last == 0) return pnb_image_level(first, size, wrap, nearest, srgb, uv);
  float detail = min(log2(texels), float(last));
  int level = min(int(detail), last - 1);
  for (int i = 0; i < level; ++i) first += size.x * size.y, size = max(size >> 1, 1);
  vec4 finer = pnb_image_level(first, size, wrap, false, srgb, uv);
  first += size.x * size.y, size = max(size >> 1, 1);
  return mix(finer, pnb_image_level(first, size, wrap, false, srgb, uv), detail - float(level));
}
