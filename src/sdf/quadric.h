// The point nearest to several planes.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace penumbra::sdf {

/// Squared distances to planes summed up (Ju et al. 2002, section 2.1).
class Quadric {
 public:
  void add(const Vec3d& point, const Vec3d& normal) {
    const double along = dot(normal, point);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) matrix_[i][k] += normal[i] * normal[k];
      right_[i] += normal[i] * along;
    }
    points_ += point, ++count_;
  }

  /// Nearest to the planes, and of all such points to the mean of the points: directions whose
  /// eigenvalue is below a twentieth of the largest count as free.
  Vec3d minimum() const {
    if (count_ == 0) return {};
    const Vec3d mean = points_ / static_cast<double>(count_);
    double a[3][3];
    Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) a[i][k] = matrix_[i][k];
    for (int sweep = 0; sweep < 12; ++sweep)
      for (const auto [p, q] : {Pair{0, 1}, Pair{0, 2}, Pair{1, 2}}) rotate(a, axes, p, q);
    Vec3d rest = right_;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) rest[i] -= matrix_[i][k] * mean[k];
    const double least = 0.05 * std::max({a[0][0], a[1][1], a[2][2]});
    Vec3d x = mean;
    for (int i = 0; i < 3; ++i)
      if (a[i][i] > least) x += axes[i] * (dot(axes[i], rest) / a[i][i]);
    return x;
  }

 private:
  struct Pair {
    int p, q;
  };

  // Jacobi's rotation that makes a[p][q] zero.
  static void rotate(double (&a)[3][3], Vec3d (&axes)[3], int p, int q) {
    if (std::abs(a[p][q]) < 1e-300) return;
    const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    const double t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
    const double c = 1 / std::sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
      const double kp = a[k][p], kq = a[k][q];
      a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
    }
    for (int k = 0; k < 3; ++k) {
      const double pk = a[p][k], qk = a[q][k];
      a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
    }
    const Vec3d ap = axes[p], aq = axes[q];
    axes[p] = ap * c - aq * s, axes[q] = ap * s + aq * c;
  }

  double matrix_[3][3] = {};
  Vec3d right_, points_;
  int count_ = 0;
};

}  // namespace penumbra::sdf
