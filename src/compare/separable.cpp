#include "compare/separable.h"

namespace penumbra {
namespace {

void add_scaled(const float* in, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

// Four at a time read and write `out` a quarter as often.
void add_four(const float* in, std::ptrdiff_t step, const float* weights, int count, float* out) {
  const float *a = in, *b = in + step, *c = in + 2 * step, *d = in + 3 * step;
  for (int i = 0; i < count; ++i)
    out[i] = out[i] + weights[0] * a[i] + weights[1] * b[i] + weights[2] * c[i] + weights[3] * d[i];
}

// Adds the values at in, in + step, in + 2 step, … times their weights.
void add_weighted(const float* in, std::ptrdiff_t step, const Kernel& kernel, int count,
                  float* out) {
  const std::size_t size = kernel.weights.size();
  std::size_t k = 0;
  for (; k + 4 <= size; k += 4, in += 4 * step)
    add_four(in, step, kernel.weights.data() + k, count, out);
  for (; k < size; ++k, in += step) add_scaled(in, kernel.weights[k], count, out);
}

}  // namespace

Plane filtered_rows(const Plane& in, const Kernel& kernel, int margin) {
  Plane out(in.width - 2 * margin, in.height);
  for (int y = 0; y < out.height; ++y)
    add_weighted(in.row(y) + margin - kernel.radius(), 1, kernel, out.width, out.row(y));
  return out;
}

Plane filtered_columns(const Plane& in, const Kernel& kernel, int margin) {
  Plane out(in.width, in.height - 2 * margin);
  for (int y = 0; y < out.height; ++y)
    add_weighted(in.row(y + margin - kernel.radius()), in.width, kernel, out.width, out.row(y));
  return out;
}

}  // namespace penumbra
