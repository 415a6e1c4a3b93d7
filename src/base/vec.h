// Small vectors. Plain aggregates, no alignment demands, so that a std::vector<Vec3> is the
// packed array of floats that Embree and file formats expect.
#pragma once

#include <algorithm>
#include <cmath>

namespace penumbra {

struct Vec2 {
  float x = 0, y = 0;
};

/// Three components, x y z or r g b.
template <class T>
struct Vec3T {
  T x = 0, y = 0, z = 0;

  constexpr Vec3T() = default;
  constexpr Vec3T(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
  explicit constexpr Vec3T(T s) : x(s), y(s), z(s) {}
  template <class U>
  explicit constexpr Vec3T(const Vec3T<U>& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}

  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }
  constexpr const T& operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr Vec3T& operator+=(const Vec3T& b) { return *this = *this + b; }
  constexpr Vec3T& operator*=(T s) { return *this = *this * s; }

  friend constexpr Vec3T operator+(const Vec3T& a, const Vec3T& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vec3T operator-(const Vec3T& a, const Vec3T& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vec3T operator*(const Vec3T& a, const Vec3T& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  friend constexpr Vec3T operator*(const Vec3T& a, T s) { return {a.x * s, a.y * s, a.z * s}; }
  friend constexpr Vec3T operator*(T s, const Vec3T& a) { return a * s; }
  friend constexpr Vec3T operator/(const Vec3T& a, T s) { return a * (T(1) / s); }
  friend constexpr Vec3T operator-(const Vec3T& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr bool operator==(const Vec3T&, const Vec3T&) = default;
};

using Vec3 = Vec3T<float>;
using Vec3d = Vec3T<double>;

template <class T>
constexpr T dot(const Vec3T<T>& a, const Vec3T<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3T<T> cross(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
T length(const Vec3T<T>& a) {
  return std::sqrt(dot(a, a));
}
/// The unit vector along a; a must not be zero.
template <class T>
Vec3T<T> normalize(const Vec3T<T>& a) {
  return a / length(a);
}
template <class T>
Vec3T<T> min(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
template <class T>
Vec3T<T> max(const Vec3T<T>& a, const Vec3T<T>& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}
template <class T>
T max_component(const Vec3T<T>& a) {
  return std::max(a.x, std::max(a.y, a.z));
}
template <class T>
Vec3T<T> abs(const Vec3T<T>& a) {
  return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}
template <class T>
bool is_finite(const Vec3T<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
/// Relative luminance of linear sRGB (Rec. 709).
template <class T>
constexpr T luminance(const Vec3T<T>& c) {
  return T(0.2126) * c.x + T(0.7152) * c.y + T(0.0722) * c.z;
}

/// An orthonormal right-handed frame (u, v, w).
struct Frame {
  Vec3 u, v, w;
};

/// Completes a unit vector w to a frame without a branch on direction
/// (Duff et al. 2017, Building an Orthonormal Basis, Revisited, listing 3).
inline Frame frame_around(const Vec3& w) {
  const float sign = std::copysign(1.0f, w.z);
  const float a = -1.0f / (sign + w.z);
  const float b = w.x * w.y * a;
  return {{1.0f + sign * w.x * w.x * a, sign * b, -sign * w.x}, {b, sign + w.y * w.y * a, -w.y}, w};
}

/// An axis-aligned box; empty until something is put in.
struct Bounds {
  Vec3 lo{INFINITY, INFINITY, INFINITY};
  Vec3 hi{-INFINITY, -INFINITY, -INFINITY};

  bool empty() const { return !(lo.x <= hi.x); }
  Vec3 center() const { return (lo + hi) * 0.5f; }
  Vec3 size() const { return empty() ? Vec3{} : hi - lo; }
  float diagonal() const { return length(size()); }
  void grow(const Vec3& p) { lo = min(lo, p), hi = max(hi, p); }
  void grow(const Bounds& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
  float half_area() const {
    const Vec3 d = size();
    return d.x * d.y + d.y * d.z + d.z * d.x;
  }
};

}  // namespace penumbra
