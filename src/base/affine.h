// Affine maps in double precision: node hierarchies multiply many of them.
#pragma once

#include "base/vec.h"

namespace penumbra {

/// p ↦ x p.x + y p.y + z p.z + t, where x, y, z are the images of the axes.
struct Affine {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t{0, 0, 0};

  Vec3d vector(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(const Vec3d& p) const { return vector(p) + t; }
  Vec3 point(const Vec3& p) const { return Vec3(point(Vec3d(p))); }
  /// Normals transform by the cofactor matrix, which is det · inverse transpose.
  Vec3d normal(const Vec3d& n) const {
    return cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z;
  }
  double determinant() const { return dot(x, cross(y, z)); }
  bool is_identity() const { return *this == Affine{}; }

  friend bool operator==(const Affine&, const Affine&) = default;
  /// (a * b)(p) = a(b(p)).
  friend Affine operator*(const Affine& a, const Affine& b) {
    return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
  }
};

/// The inverse; a.determinant() must not be zero.
inline Affine inverse(const Affine& a) {
  const double inv = 1.0 / a.determinant();
  const Vec3d r0 = cross(a.y, a.z) * inv, r1 = cross(a.z, a.x) * inv, r2 = cross(a.x, a.y) * inv;
  Affine m{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  m.t = -m.vector(a.t);
  return m;
}

/// True if the map keeps angles up to a relative error of 1e-5: rotation, mirroring, uniform scale.
inline bool is_similarity(const Affine& a) {
  const double xx = dot(a.x, a.x), yy = dot(a.y, a.y), zz = dot(a.z, a.z);
  const double e = 1e-5 * xx;
  return std::abs(xx - yy) < e && std::abs(xx - zz) < e && std::abs(dot(a.x, a.y)) < e &&
         std::abs(dot(a.y, a.z)) < e && std::abs(dot(a.z, a.x)) < e;
}

}  // namespace penumbra
