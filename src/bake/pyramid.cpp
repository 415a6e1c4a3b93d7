#include "bake/pyramid.h"

namespace penumbra::bake {
namespace {

/// Sine of the angle between base plane and pyramid, or between the edges, that double precision
/// no longer tells from zero.
constexpr double flat = 1e-12;

/// e_w · (e_y × e_x), or no value if it is lost in rounding.
std::optional<double> volume(const Vec3d& e_w, const Parallelogram& base) {
  const double v = dot(e_w, cross(base.edge_y, base.edge_x));
  const double size = length(e_w) * length(base.edge_x) * length(base.edge_y);
  if (!(std::abs(v) > flat * size)) return std::nullopt;
  return v;
}

}  // namespace

// x is 0 on the plane through a, b and b + e_y, whose normal is n_x = e_w × e_y with e_w = b − a,
// and 1 at b + e_x: x = n_x · (p − a) / n_x · e_x. Likewise y with n_y = e_x × e_w. w is 0 at a and
// 1 on the base plane: w = n_w · (p − a) / n_w · e_w with n_w = e_y × e_x. The three divisors are
// one triple product: n_x · e_x = n_y · e_y = n_w · e_w.
std::optional<PyramidToBox> pyramid_to_box(const Vec3d& apex, const Parallelogram& base) {
  const Vec3d e_w = base.base - apex;
  const auto v = volume(e_w, base);
  if (!v) return std::nullopt;
  PyramidToBox m;
  m.origin = apex;
  m.x = cross(e_w, base.edge_y) / *v;
  m.y = cross(base.edge_x, e_w) / *v;
  m.w = cross(base.edge_y, base.edge_x) / *v;
  return m;
}

// As the apex goes to infinity along d, e_w / |e_w| goes to −d: n_x and n_y keep their directions,
// w goes to 1, and x and y, now zero on planes through b alone, lose their dependence on a.
std::optional<PyramidToBox> prism_to_box(const Vec3d& towards, const Parallelogram& base) {
  const auto v = volume(-towards, base);
  if (!v) return std::nullopt;
  PyramidToBox m;
  m.origin = base.base;
  m.x = cross(-towards, base.edge_y) / *v;
  m.y = cross(base.edge_x, -towards) / *v;
  m.w_0 = 1;
  return m;
}

}  // namespace penumbra::bake
