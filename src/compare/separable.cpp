#include "compare/separable.h"

namespace penumbra {
namespace {

void add_scaled(const float* in, float weight, int count, float* out) {
  for (int i = 0; i < count; ++i) out[i] += weight * in[i];
}

}  // namespace

Plane filtered_rows(const Plane& in, const Kernel& kernel, int margin) {
  Plane out(in.width - 2 * margin, in.height);
  const int first = margin - kernel.radius();
  for (int y = 0; y < out.height; ++y)
    for (std::size_t k = 0; k < kernel.weights.size(); ++k)
      add_scaled(in.row(y) + first + k, kernel.weights[k], out.width, out.row(y));
  return out;
}

Plane filtered_columns(const Plane& in, const Kernel& kernel, int margin) {
  Plane out(in.width, in.height - 2 * margin);
  const int first = margin - kernel.radius();
  for (int y = 0; y < out.height; ++y)
    for (std::size_t k = 0; k < kernel.weights.size(); ++k)
      add_scaled(in.row(y + first + static_cast<int>(k)), kernel.weights[k], out.width, out.row(y));
  return out;
}

}  // namespace penumbra
