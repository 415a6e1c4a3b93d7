#include "render/segment_irradiance.h"

#include <numbers>

namespace penumbra {
namespace {

/// The line's distance h from the receiver, its height above the horizon at the foot of h, and how
/// much that height grows per metre along it.
struct LineView {
  double h, foot_height, slope;
};

/// ∫ (foot_height + slope l) h / (h² + l²)² dl.
double integral(const LineView& line, double from, double to) {
  const double h2 = line.h * line.h;
  const auto level = [&](double l) {
    return l * line.h / (2 * h2 * (h2 + l * l)) + std::atan2(l, line.h) / (2 * h2);
  };
  const auto rising = [&](double l) { return -line.h / (2 * (h2 + l * l)); };
  return line.foot_height * (level(to) - level(from)) + line.slope * (rising(to) - rising(from));
}

}  // namespace

float segment_irradiance(const Vec3& a, const Vec3& b, float radius, const Vec3& normal,
                         Horizon horizon) {
  const Vec3d start(a), whole = Vec3d(b) - start, n(normal);
  const double size = length(whole);
  if (!(size > 0) || !(radius > 0)) return 0;
  const Vec3d along = whole / size;
  double from = dot(start, along), to = from + size;
  const Vec3d foot = start - along * from;
  const LineView line{std::max(length(foot), double(radius)), dot(n, foot), dot(n, along)};
  if (horizon == Horizon::exact && line.slope != 0) {
    const double sets = -line.foot_height / line.slope;
    if (line.slope > 0) from = std::clamp(sets, from, to);
    if (line.slope < 0) to = std::clamp(sets, from, to);
  }
  const double e = 2 * radius * integral(line, from, to);
  return static_cast<float>(std::clamp(e, 0.0, std::numbers::pi));
}

}  // namespace penumbra
