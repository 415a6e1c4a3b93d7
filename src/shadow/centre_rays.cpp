#include "shadow/centre_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/centre_rays.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 8>;
using Floats = hn::Vec<Lanes>;

HWY_INLINE Floats all(float x) { return hn::Set(Lanes(), x); }

struct Point {
  Floats x, y, z;
};

// Without fused operations: the sums are those of Vec3.
HWY_INLINE Floats dot(const Point& a, const Point& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Floats plus(Floats a, Floats b, Floats s) { return hn::Add(a, hn::Mul(b, s)); }

/// Receivers side by side.
struct Eight {
  HWY_ALIGN float position[3][8];
  HWY_ALIGN float normal[3][8];
};

HWY_INLINE void lanes(const Eight& from, const CentreLight& light, std::size_t first, RTCRay8& rays,
                      int* valid) {
  const Lanes d;
  const auto load = [&](const float(&a)[3][8]) {
    return Point{hn::Load(d, a[0] + first), hn::Load(d, a[1] + first), hn::Load(d, a[2] + first)};
  };
  const Point p = load(from.position), n = load(from.normal);
  const Floats size = hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
  const Floats epsilon = hn::Max(hn::Mul(size, all(light.roundings)), all(light.least_epsilon));
  Point way{all(light.at.x), all(light.at.y), all(light.at.z)};
  Floats t_max = all(INFINITY);
  if (!light.endless) {
    way = {hn::Sub(way.x, p.x), hn::Sub(way.y, p.y), hn::Sub(way.z, p.z)};
    t_max = hn::Sqrt(dot(way, way));
    if (light.flat) {
      const Point plane{all(light.normal.x), all(light.normal.y), all(light.normal.z)};
      const Floats height = hn::Abs(dot(plane, way));
      const Floats lean = hn::Max(hn::Div(height, t_max), all(1e-4f));
      const Floats on_plane = hn::Mul(all(2), hn::Add(all(light.epsilon), epsilon));
      t_max = hn::Sub(t_max, hn::Div(on_plane, lean));
    }
    const Floats distance = light.flat ? hn::Sqrt(dot(way, way)) : t_max;
    way = {hn::Div(way.x, distance), hn::Div(way.y, distance), hn::Div(way.z, distance)};
  }
  hn::Store(plus(p.x, n.x, epsilon), d, rays.org_x + first);
  hn::Store(plus(p.y, n.y, epsilon), d, rays.org_y + first);
  hn::Store(plus(p.z, n.z, epsilon), d, rays.org_z + first);
  hn::Store(way.x, d, rays.dir_x + first);
  hn::Store(way.y, d, rays.dir_y + first);
  hn::Store(way.z, d, rays.dir_z + first);
  hn::Store(t_max, d, rays.tfar + first);
  // Also false for a receiver at the centre, whose direction is not a number.
  const hn::RebindToSigned<Lanes> di;
  const auto facing = hn::RebindMask(di, hn::Gt(dot(way, n), hn::Zero(d)));
  hn::Store(hn::VecFromMask(di, facing), di, valid + first);
}

void centre_rays(const Receiver* receivers, std::size_t count, const CentreLight& light,
                 RTCRay8& rays, int* valid) {
  Eight from;
  for (std::size_t i = 0; i < 8; ++i) {
    const Receiver& r = receivers[i < count ? i : count - 1];
    for (int axis = 0; axis < 3; ++axis) {
      from.position[axis][i] = r.position[axis];
      from.normal[axis][i] = r.normal[axis];
    }
  }
  for (std::size_t first = 0; first < 8; first += hn::Lanes(Lanes()))
    lanes(from, light, first, rays, valid);
  for (std::size_t i = count; i < 8; ++i) valid[i] = 0;
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

namespace penumbra {

HWY_EXPORT(centre_rays);

void make_centre_rays(std::span<const Receiver> receivers, const CentreLight& light, RTCRay8& rays,
                      int* valid) {
  HWY_DYNAMIC_DISPATCH(centre_rays)(receivers.data(), receivers.size(), light, rays, valid);
  std::fill_n(rays.tnear, 8, 0.0f);
  std::fill_n(rays.time, 8, 0.0f);
  std::fill_n(rays.mask, 8, 0xffffffffu);
  std::fill_n(rays.id, 8, 0u);
  std::fill_n(rays.flags, 8, 0u);
}

}  // namespace penumbra
#endif
