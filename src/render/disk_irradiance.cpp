#include "render/disk_irradiance.h"

#include <numbers>

namespace penumbra {
namespace {

/// Heights and directions in the plane that holds the disk's axis and the receiver:
/// u from the axis' foot outwards to the centre, w the disk's normal, v = w × u.
struct AxisView {
  Vec3 u, v, w;
  double h = 0;  ///< height of the receiver above the disk's plane
  double r = 0;  ///< distance of the receiver from the axis
  double a = 0;  ///< h² + r² + R²
  double s = 0;  ///< √(a² − 4 r² R²)
  double radius = 0;
};

AxisView axis_view(const DiskView& disk, float h) {
  const Vec3 aside = disk.center + disk.normal * h;
  const double r = length(Vec3d(aside)), radius = disk.radius;
  const double near2 = double(h) * h + (r - radius) * (r - radius);
  const double far2 = double(h) * h + (r + radius) * (r + radius);
  AxisView view;
  view.w = disk.normal;
  view.h = h;
  view.r = r;
  view.radius = radius;
  view.u = r > 0 ? normalize(aside) : frame_around(disk.normal).u;
  view.v = cross(view.w, view.u);
  view.a = double(h) * h + r * r + radius * radius;
  view.s = std::sqrt(near2 * far2);
  return view;
}

/// n · Φ, the disk's vector irradiance on a receiver that sees all of it. Both factors are written
/// without the difference that cancels for a small disk.
double whole(const AxisView& d, const Vec3& n) {
  const double r2 = d.radius * d.radius, e = d.h * d.h + d.r * d.r - r2;
  const double facing = e > 0 ? 4 * d.h * d.h * r2 / (d.s + e) : d.s - e;
  const double axial = 0.5 * std::numbers::pi * facing / d.s;
  const double radial = 2 * std::numbers::pi * d.h * d.r * r2 / ((d.a + d.s) * d.s);
  return radial * dot(n, d.u) - axial * dot(n, d.w);
}

/// ∫ dφ / (a + b cos φ) from 0 to φ, continued smoothly past ±π.
double angle_integral(const AxisView& d, double b, double phi) {
  constexpr double turn = 2 * std::numbers::pi;
  const double turns = std::round(phi / turn);
  const double g = std::sqrt((d.a - b) / (d.a + b));
  return 2 / d.s * (std::atan(g * std::tan(0.5 * (phi - turn * turns))) + turns * std::numbers::pi);
}

/// ½ ∫ n · (p × dp) / p² along p(φ) = centre + R (u cos φ + v sin φ). The integrand is
/// (p + q cos φ + t sin φ) / (a + b cos φ).
double arc(const AxisView& d, const Vec3& n, double from, double to) {
  const double nu = dot(n, d.u), nv = dot(n, d.v), nw = dot(n, d.w), radius = d.radius;
  const double p = radius * radius * nw, q = radius * (d.h * nu + d.r * nw), t = radius * d.h * nv;
  const double b = 2 * d.r * radius;
  if (b < 1e-5 * d.a)
    return 0.5 / d.a *
           (p * (to - from) + q * (std::sin(to) - std::sin(from)) -
            t * (std::cos(to) - std::cos(from)));
  const double inner = angle_integral(d, b, to) - angle_integral(d, b, from);
  const double log_term = std::log((d.a + b * std::cos(to)) / (d.a + b * std::cos(from)));
  return 0.5 * (q / b * (to - from) + (p - q * d.a / b) * inner - t / b * log_term);
}

Vec3d rim(const AxisView& d, double phi) {
  return Vec3d(d.u) * (d.r + d.radius * std::cos(phi)) + Vec3d(d.v) * (d.radius * std::sin(phi)) -
         Vec3d(d.w) * d.h;
}

/// The disk crosses the horizon: the arc above it, closed by the chord in the horizon.
double crossing(const AxisView& d, const Vec3& n, double height, double reach) {
  const double middle = std::atan2(double(dot(n, d.v)), double(dot(n, d.u)));
  const double half = std::acos(std::clamp(-height / reach, -1.0, 1.0));
  const double from = middle - half, to = middle + half;
  const Vec3d a = rim(d, to), b = rim(d, from), c = cross(a, b);
  const double chord = std::copysign(std::atan2(length(c), dot(a, b)), dot(c, Vec3d(n)));
  return std::abs(arc(d, n, from, to) + 0.5 * chord);
}

}  // namespace

float disk_irradiance(const DiskView& disk, const Vec3& normal, Horizon horizon) {
  const float h = -dot(disk.center, disk.normal);
  if (!(h > 0) || !(disk.radius > 0)) return 0;
  const float along = dot(normal, disk.normal), height = dot(normal, disk.center);
  const float reach = disk.radius * std::sqrt(std::max(0.0f, 1.0f - along * along));
  if (height + reach <= 0) return 0;
  const AxisView view = axis_view(disk, h);
  if (height >= reach || horizon == Horizon::centre)
    return static_cast<float>(std::max(0.0, whole(view, normal)));
  return static_cast<float>(crossing(view, normal, height, reach));
}

}  // namespace penumbra
