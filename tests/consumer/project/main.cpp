#include <penumbra/parker.h>

#include <cmath>
#include <cstdio>

namespace parker = penumbra::parker;

/// A point at the origin, a light of diameter 1 at height 10, and a unit sphere at height 5 whose
/// centre is 1.25 off the ray: b = 5 · 1 / 10 = 0.5, so tau = (1.25 − 1) / 0.5 = 0.5.
int main() {
  const parker::ShadowRay ray{{0, 0, 0}, {0, 1, 0}, 10.0f, 0.1f};
  const float tau = parker::sphere_tau(ray, {1.25f, 5, 0}, 1.0f);
  const float fraction = parker::cubic(tau);
  std::printf("tau %.6f, visible fraction %.6f\n", tau, fraction);
  return std::abs(tau - 0.5f) < 1e-5f && std::abs(fraction - 0.5f) < 1e-5f ? 0 : 1;
}
