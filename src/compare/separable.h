// Separable filters of planes of floats.
#pragma once

#include <cstddef>
#include <vector>

namespace penumbra {

struct Plane {
  int width = 0, height = 0;
  std::vector<float> values;

  Plane(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
  const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// Weights of the neighbours −radius … radius.
struct Kernel {
  std::vector<float> weights;
  int radius() const { return static_cast<int>(weights.size() / 2); }
};

/// out(x, y) = Σ over k of weights[k] · in(x + margin + k − radius, y): narrower than `in` by twice
/// the margin, which is at least the radius.
Plane filtered_rows(const Plane& in, const Kernel& kernel, int margin);
/// The same along columns: lower than `in` by twice the margin.
Plane filtered_columns(const Plane& in, const Kernel& kernel, int margin);

}  // namespace penumbra
