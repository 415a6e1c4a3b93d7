#include "shadow/centre_views.h"

#include <algorithm>
#include <bit>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/centre_views.cpp"
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

HWY_INLINE Point all(const Vec3& v) { return {all(v.x), all(v.y), all(v.z)}; }

// Without fused operations: the sums are those of Vec3.
HWY_INLINE Floats dot(const Point& a, const Point& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// As many receivers as there are lanes.
HWY_INLINE void load(const Receiver* from, Point& position, Point& normal) {
  static_assert(sizeof(Receiver) == 6 * sizeof(float));
  const Lanes d;
  const auto* floats = reinterpret_cast<const float*>(from);
  Point low, high;  // positions and normals take turns in each
  hn::LoadInterleaved3(d, floats, low.x, low.y, low.z);
  hn::LoadInterleaved3(d, floats + 3 * hn::Lanes(d), high.x, high.y, high.z);
#if HWY_TARGET == HWY_SCALAR
  position = low, normal = high;
#else
  position = {hn::ConcatEven(d, high.x, low.x), hn::ConcatEven(d, high.y, low.y),
              hn::ConcatEven(d, high.z, low.z)};
  normal = {hn::ConcatOdd(d, high.x, low.x), hn::ConcatOdd(d, high.y, low.y),
            hn::ConcatOdd(d, high.z, low.z)};
#endif
}

class CentreViews {
 public:
  CentreViews(const CentreLight& light, ConeBatch& queries, std::uint32_t* which)
      : light_(light), first_(queries.column(0)), stride_(queries.stride()), which_(which) {}

  std::size_t size() const { return size_; }

  /// Adds those of a vector of receivers, the first of which is number `first`, of which `count`
  /// exist and have the light above their horizon.
  void add(const Receiver* receivers, std::size_t first, std::size_t count) {
    const Lanes d;
    Point p, n;
    load(receivers, p, n);
    Point way = all(light_.at);
    Floats distance = all(INFINITY), outer = all(light_.diameter);
    if (!light_.endless) {
      way = {hn::Sub(way.x, p.x), hn::Sub(way.y, p.y), hn::Sub(way.z, p.z)};
      distance = hn::Sqrt(dot(way, way));
      const Floats inverse = hn::Div(all(1), distance);
      way = {hn::Mul(way.x, inverse), hn::Mul(way.y, inverse), hn::Mul(way.z, inverse)};
      outer = hn::Div(outer, distance);
    }
    // Also false for a receiver at the centre, whose direction is not a number.
    keep(hn::And(hn::Gt(dot(way, n), hn::Zero(d)), hn::FirstN(d, count)), first);
    put(ConeBatch::origin, p), put(ConeBatch::direction, way), put(ConeBatch::horizon, n);
    put(ConeBatch::distance, distance), put(ConeBatch::outer, outer);
    const Floats size = hn::Max(hn::Max(hn::Abs(p.x), hn::Abs(p.y)), hn::Abs(p.z));
    const Floats rounding = hn::Mul(size, all(light_.roundings));
    put(ConeBatch::epsilon, hn::Max(rounding, all(light_.least_epsilon)));
    if (light_.flat) {
      const Point plane = all(light_.normal), at = all(light_.at);
      const Floats height =
          dot(plane, {hn::Sub(p.x, at.x), hn::Sub(p.y, at.y), hn::Sub(p.z, at.z)});
      const Floats side = hn::IfThenElse(hn::Lt(height, hn::Zero(d)), all(-1), all(1));
      put(ConeBatch::plane_normal,
          {hn::Mul(plane.x, side), hn::Mul(plane.y, side), hn::Mul(plane.z, side)});
      put(ConeBatch::plane_distance, hn::Abs(height));
      const Floats on_plane = hn::Max(rounding, all(light_.least_on_plane));
      put(ConeBatch::plane_epsilon, hn::Mul(all(2), hn::Add(all(light_.epsilon), on_plane)));
    }
    size_ += kept_;
  }

 private:
  /// Notes which lanes are kept, and their numbers.
  void keep(hn::Mask<Lanes> mask, std::size_t first) {
    const Lanes d;
    whole_ = hn::AllTrue(d, mask);
    if (whole_) {
      const hn::RebindToUnsigned<Lanes> du;
      hn::StoreU(hn::Iota(du, static_cast<std::uint32_t>(first)), du, which_ + size_);
      kept_ = hn::Lanes(d);
      return;
    }
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    HWY_ALIGN std::int32_t lanes[8] = {};
    kept_ = 0;
    for (unsigned rest = bits[0]; rest; rest &= rest - 1) {
      const int lane = std::countr_zero(rest);
      lanes[kept_] = lane;
      which_[size_ + kept_++] = static_cast<std::uint32_t>(first) + lane;
    }
    moved_ = hn::SetTableIndices(d, lanes);
  }

  // What is written beyond those kept is overwritten by the next, or is room that clear() made.
  void put(std::size_t column, Floats v) {
    const Lanes d;
    hn::StoreU(whole_ ? v : hn::TableLookupLanes(v, moved_), d, first_ + column * stride_ + size_);
  }
  void put(std::size_t column, const Point& v) {
    put(column, v.x), put(column + 1, v.y), put(column + 2, v.z);
  }

  const CentreLight& light_;
  float* first_;
  std::size_t stride_, size_ = 0;
  std::uint32_t* which_;
  std::size_t kept_ = 0;
  bool whole_ = false;
  decltype(hn::SetTableIndices(Lanes(), std::declval<const std::int32_t*>())) moved_;
};

void find_views(const Receiver* receivers, std::size_t count, const CentreLight& light,
                ConeBatch& queries, std::uint32_t* which) {
  const std::size_t n = hn::Lanes(Lanes());
  CentreViews views(light, queries, which);
  std::size_t first = 0;
  for (; first + n <= count; first += n) views.add(receivers + first, first, n);
  if (first < count) {
    Receiver last[8];
    std::copy(receivers + first, receivers + count, last);
    views.add(last, first, count - first);
  }
  queries.set_size(views.size());
}

void write_rays(const ConeBatch& queries, std::size_t first, RTCRay8& rays, int* valid) {
  const Lanes d;
  for (std::size_t at = 0; at < 8; at += hn::Lanes(d)) {
    const auto column = [&](std::size_t c) { return hn::LoadU(d, queries.column(c) + first + at); };
    const Floats epsilon = column(ConeBatch::epsilon);
    const auto origin = [&](std::size_t axis) {
      return hn::Add(column(ConeBatch::origin + axis),
                     hn::Mul(column(ConeBatch::horizon + axis), epsilon));
    };
    hn::Store(origin(0), d, rays.org_x + at);
    hn::Store(origin(1), d, rays.org_y + at);
    hn::Store(origin(2), d, rays.org_z + at);
    hn::Store(column(ConeBatch::direction), d, rays.dir_x + at);
    hn::Store(column(ConeBatch::direction + 1), d, rays.dir_y + at);
    hn::Store(column(ConeBatch::direction + 2), d, rays.dir_z + at);
    Floats t_max = column(ConeBatch::distance);
    if (queries.has_plane()) {
      // What is on the light's own plane does not occlude: stop short of it, measured across it.
      const Floats lean = hn::Max(hn::Div(column(ConeBatch::plane_distance), t_max), all(1e-4f));
      t_max = hn::Sub(t_max, hn::Div(column(ConeBatch::plane_epsilon), lean));
    }
    hn::Store(t_max, d, rays.tfar + at);
    const hn::RebindToSigned<Lanes> di;
    const auto number = hn::Iota(di, static_cast<int>(at));
    const int left = static_cast<int>(std::min<std::size_t>(queries.size() - first, 8));
    hn::Store(hn::VecFromMask(di, hn::Lt(number, hn::Set(di, left))), di, valid + at);
  }
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace penumbra {

HWY_EXPORT(find_views);
HWY_EXPORT(write_rays);

void find_centre_views(std::span<const Receiver> receivers, const CentreLight& light,
                       ConeBatch& queries, std::vector<std::uint32_t>& which) {
  constexpr std::size_t vector = 8;
  queries.clear(receivers.size(), light.flat, -1);
  if (which.size() < receivers.size() + vector) which.resize(receivers.size() + vector);
  HWY_DYNAMIC_DISPATCH(find_views)
  (receivers.data(), receivers.size(), light, queries, which.data());
}

void write_centre_rays(const ConeBatch& queries, std::size_t first, RTCRay8& rays, int* valid) {
  HWY_DYNAMIC_DISPATCH(write_rays)(queries, first, rays, valid);
}

}  // namespace penumbra
#endif
