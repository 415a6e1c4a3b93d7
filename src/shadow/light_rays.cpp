#include "shadow/light_rays.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "shadow/light_rays.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include <hwy/highway.h>

#include "geometry/embree_scene.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, LightPacket::size>;
using Floats = hn::Vec<Lanes>;
using Shape = LightPoints::Shape;
using Kind = Shape::Kind;

HWY_INLINE Floats all(float x) { return hn::Set(Lanes(), x); }

struct Point {
  Floats x, y, z;
};

HWY_INLINE Floats dot(const Point& a, const Point& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Floats dot(const Vec3& a, const Point& b) {
  return hn::MulAdd(all(a.x), b.x, hn::MulAdd(all(a.y), b.y, hn::Mul(all(a.z), b.z)));
}
/// base + u a + v b
HWY_INLINE Point across(const Vec3& base, const Vec3& u, Floats a, const Vec3& v, Floats b) {
  return {hn::MulAdd(all(u.x), a, hn::MulAdd(all(v.x), b, all(base.x))),
          hn::MulAdd(all(u.y), a, hn::MulAdd(all(v.y), b, all(base.y))),
          hn::MulAdd(all(u.z), a, hn::MulAdd(all(v.z), b, all(base.z)))};
}

/// Some lanes of a packet.
struct Targets {
  Point direction;
  Floats t_max, weight;
};

HWY_INLINE Targets on_cone(const Shape& s, Floats x, Floats y) {
  const Floats u = hn::MulAdd(x, x, hn::Mul(y, y)), c = all(s.one_minus_cosine);
  const Floats z = hn::NegMulAdd(u, c, all(1));
  // (1 − z²) / u, without the difference that a small light would lose.
  const Floats across2 = hn::Max(hn::Mul(c, hn::Add(all(1), z)), all(0));
  const Floats k = hn::Sqrt(across2), kx = hn::Mul(k, x), ky = hn::Mul(k, y);
  const Point d{hn::MulAdd(all(s.u.x), kx, hn::MulAdd(all(s.v.x), ky, hn::Mul(all(s.w.x), z))),
                hn::MulAdd(all(s.u.y), kx, hn::MulAdd(all(s.v.y), ky, hn::Mul(all(s.w.y), z))),
                hn::MulAdd(all(s.u.z), kx, hn::MulAdd(all(s.v.z), ky, hn::Mul(all(s.w.z), z)))};
  if (!(s.distance < INFINITY)) return {d, all(INFINITY), all(s.solid_angle)};
  // Where the ray enters the sphere, or leaves it if it began inside.
  const Floats sine2 = hn::Mul(u, across2);
  const Floats half = hn::Sqrt(hn::Max(
      hn::NegMulAdd(all(s.distance * s.distance), sine2, all(s.radius * s.radius)), all(0)));
  const Floats side = all(s.distance > s.radius ? -1.0f : 1.0f);
  return {d, hn::MulAdd(side, half, hn::Mul(all(s.distance), z)), all(s.solid_angle)};
}

HWY_INLINE Targets on_surface(const Shape& s, const Point& to, const Point& normal) {
  const Floats d2 = dot(to, to);
  const Floats inv = hn::Div(all(1), hn::Sqrt(hn::Max(d2, all(1e-30f))));
  const Point d{hn::Mul(to.x, inv), hn::Mul(to.y, inv), hn::Mul(to.z, inv)};
  const Floats cosine = hn::Neg(dot(d, normal)), size = hn::Abs(cosine);
  const Floats facing = s.two_sided ? size : hn::Max(cosine, all(0));
  // Stop short of the light's own plane by epsilon, measured across it.
  const Floats short_of = hn::Div(all(s.epsilon), hn::Max(size, all(1e-4f)));
  return {d, hn::MulSub(d2, inv, short_of),
          hn::Mul(hn::Mul(all(s.area), facing), hn::Mul(inv, inv))};
}

HWY_INLINE Targets on_faces(const LightPoints& points, Floats x, Floats y) {
  HWY_ALIGN float at[2][LightPacket::size], to[3][LightPacket::size], n[3][LightPacket::size];
  const Lanes d;
  hn::Store(x, d, at[0]), hn::Store(y, d, at[1]);
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    const auto p = points.on_face(at[0][i], at[1][i]);
    for (int axis = 0; axis < 3; ++axis) to[axis][i] = p.to[axis], n[axis][i] = p.normal[axis];
  }
  return on_surface(points.shape(), {hn::Load(d, to[0]), hn::Load(d, to[1]), hn::Load(d, to[2])},
                    {hn::Load(d, n[0]), hn::Load(d, n[1]), hn::Load(d, n[2])});
}

HWY_INLINE Targets on_line(const Shape& s, Floats x) {
  const Point to = across(s.center, s.u, x, Vec3(), x);
  const Floats d2 = hn::Max(dot(to, to), all(1e-30f)), length = hn::Sqrt(d2);
  const Floats inv = hn::Div(all(1), length);
  const Point d{hn::Mul(to.x, inv), hn::Mul(to.y, inv), hn::Mul(to.z, inv)};
  if (s.kind == Kind::point) return {d, length, hn::Mul(inv, inv)};
  // |u × d|, without the difference of squares.
  const Point c{hn::MulSub(all(s.u.y), d.z, hn::Mul(all(s.u.z), d.y)),
                hn::MulSub(all(s.u.z), d.x, hn::Mul(all(s.u.x), d.z)),
                hn::MulSub(all(s.u.x), d.y, hn::Mul(all(s.u.y), d.x))};
  const Floats apparent = hn::Mul(all(2 * s.radius), hn::Sqrt(dot(c, c)));
  return {d, length, hn::Mul(apparent, hn::Mul(inv, inv))};
}

HWY_INLINE Targets targets_at(const LightPoints& points, Floats x, Floats y) {
  const Shape& s = points.shape();
  switch (s.kind) {
    case Kind::cone:
      return on_cone(s, x, y);
    case Kind::plane:
      return on_surface(s, across(s.center, s.u, x, s.v, y),
                        {all(s.normal.x), all(s.normal.y), all(s.normal.z)});
    case Kind::faces:
      return on_faces(points, x, y);
    case Kind::line:
    case Kind::point:
      break;
  }
  return on_line(s, x);
}

HWY_INLINE Floats wrapped(Floats x) {
  const Floats one = all(1);
  return hn::Sub(x, hn::IfThenElseZero(hn::Ge(x, one), one));
}

HWY_INLINE Targets targets_at(const LightPoints& points, const SamplePattern& p, const float* xs,
                              const float* ys) {
  const Floats x = hn::LoadU(Lanes(), xs), y = hn::LoadU(Lanes(), ys);
  if (!points.takes_disk())
    return targets_at(points, wrapped(hn::Add(x, all(p.shift.x))),
                      wrapped(hn::Add(y, all(p.shift.y))));
  const Floats c = all(p.cosine), s = all(p.sine);
  return targets_at(points, hn::MulSub(c, x, hn::Mul(s, y)), hn::MulAdd(s, x, hn::Mul(c, y)));
}

void make_packet(const LightPoints& points, const SamplePattern& pattern, const float* x,
                 const float* y, LightPacket& out) {
  const Lanes d;
  for (std::size_t i = 0; i < LightPacket::size; i += hn::Lanes(d)) {
    const Targets t = targets_at(points, pattern, x + i, y + i);
    hn::Store(t.direction.x, d, out.x + i), hn::Store(t.direction.y, d, out.y + i);
    hn::Store(t.direction.z, d, out.z + i), hn::Store(t.t_max, d, out.t_max + i);
    hn::Store(t.weight, d, out.weight + i);
  }
}

/// Bits of the first `count` lanes whose direction is above the horizon; the rays made ready.
HWY_INLINE std::uint32_t aim(const LightRays::Setup& setup, const float* x, const float* y,
                             int count, RTCRay8& rays, int* valid, LightPacket* out) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  std::uint32_t up = 0;
  for (std::size_t i = 0; i < LightPacket::size; i += hn::Lanes(d)) {
    const Targets t = targets_at(setup.points, setup.pattern, x + i, y + i);
    hn::StoreU(t.direction.x, d, rays.dir_x + i), hn::StoreU(t.direction.y, d, rays.dir_y + i);
    hn::StoreU(t.direction.z, d, rays.dir_z + i);
    hn::StoreU(hn::Max(t.t_max, all(0)), d, rays.tfar + i);
    const auto above =
        hn::And(hn::Gt(dot(setup.normal, t.direction), all(0)),
                hn::Lt(hn::Iota(d, static_cast<float>(i)), all(static_cast<float>(count))));
    hn::Store(hn::BitCast(di, hn::VecFromMask(d, above)), di, valid + i);
    up |= static_cast<std::uint32_t>(hn::CountTrue(d, above));
    if (!out) continue;
    hn::Store(t.direction.x, d, out->x + i), hn::Store(t.direction.y, d, out->y + i);
    hn::Store(t.direction.z, d, out->z + i), hn::Store(t.t_max, d, out->t_max + i);
    hn::Store(t.weight, d, out->weight + i);
  }
  return up;
}

/// Bits of the rays that arrived. Embree leaves tfar < 0 where something blocks.
HWY_INLINE std::uint8_t arrived(const RTCRay8& rays, const int* valid, int& traced, int& visible) {
  const Lanes d;
  const hn::RebindToSigned<Lanes> di;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < LightPacket::size; i += hn::Lanes(d)) {
    const auto was_traced = hn::MaskFromVec(hn::BitCast(d, hn::Load(di, valid + i)));
    const auto seen = hn::And(was_traced, hn::Ge(hn::LoadU(d, rays.tfar + i), all(0)));
    traced += static_cast<int>(hn::CountTrue(d, was_traced));
    visible += static_cast<int>(hn::CountTrue(d, seen));
    HWY_ALIGN std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, seen, bytes);
    bits |= static_cast<std::uint32_t>(bytes[0]) << i;
  }
  return static_cast<std::uint8_t>(bits);
}

int trace_points(const LightRays::Setup& setup, const float* x, const float* y, int count,
                 LightPacket* targets, std::uint8_t* visible_bits, ShadowCounts& counts) {
  alignas(32) RTCRay8 rays;
  alignas(32) int valid[LightPacket::size];
  const Lanes d;
  for (std::size_t i = 0; i < LightPacket::size; i += hn::Lanes(d)) {
    hn::StoreU(all(setup.origin.x), d, rays.org_x + i);
    hn::StoreU(all(setup.origin.y), d, rays.org_y + i);
    hn::StoreU(all(setup.origin.z), d, rays.org_z + i);
    hn::StoreU(all(0), d, rays.tnear + i), hn::StoreU(all(0), d, rays.time + i);
  }
  for (std::size_t i = 0; i < LightPacket::size; ++i)
    rays.mask[i] = 0xffffffffu, rays.id[i] = 0, rays.flags[i] = 0;
  int traced = 0, visible = 0;
  for (int first = 0; first < count; first += LightPacket::size) {
    LightPacket* out = targets ? targets++ : nullptr;
    if (aim(setup, x + first, y + first, count - first, rays, valid, out) != 0 && setup.world)
      setup.world->occluded(valid, rays, setup.own_instance, &counts.unfinished_rays);
    *visible_bits++ = arrived(rays, valid, traced, visible);
  }
  if (setup.world) counts.rays += static_cast<std::uint64_t>(traced);
  return visible;
}

}  // namespace penumbra::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace penumbra {

HWY_EXPORT(make_packet);
HWY_EXPORT(trace_points);

void LightPoints::packet(const SamplePattern& pattern, const float* x, const float* y,
                         LightPacket& out) const {
  HWY_DYNAMIC_DISPATCH(make_packet)(*this, pattern, x, y, out);
}

LightRays::LightRays(const World& world, const LightViews& lights, const Receiver& receiver,
                     std::size_t light, const SamplePattern& pattern, bool unoccluded)
    : points_(lights, light, receiver.position,
              on_plane_epsilon(world, lights.light(light).position, receiver.position)),
      pattern_(pattern),
      setup_{points_,
             pattern_,
             unoccluded ? nullptr : &world,
             receiver.position + receiver.normal * world.epsilon_at(receiver.position),
             receiver.normal,
             lights.light(light).type == LightType::mesh ? lights.light(light).instance : -1} {}

const float* LightRays::table_x() const {
  return points_.takes_disk() ? pattern_.disk_x : pattern_.square_x;
}
const float* LightRays::table_y() const {
  return points_.takes_disk() ? pattern_.disk_y : pattern_.square_y;
}

int LightRays::trace(const float* x, const float* y, int count, LightPacket* targets,
                     std::uint8_t* visible, ShadowCounts& counts) const {
  return HWY_DYNAMIC_DISPATCH(trace_points)(setup_, x, y, count, targets, visible, counts);
}

void LightRays::make(const float* x, const float* y, int count, LightPacket* targets) const {
  for (int first = 0; first < count; first += LightPacket::size)
    points_.packet(pattern_, x + first, y + first, *targets++);
}

}  // namespace penumbra
#endif
