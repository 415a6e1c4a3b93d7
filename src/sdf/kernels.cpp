// Everything that runs tapes, for each SIMD target.
#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sdf/kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target:
#include "sdf/intervals-inl.h"
#include "sdf/march-inl.h"
#include "sdf/owners-inl.h"
#include "sdf/surfaces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace penumbra::sdf::HWY_NAMESPACE {

// Lanes past the end repeat the last point.
HWY_INLINE P points_at(const float* x, const float* y, const float* z, std::size_t count) {
  HWY_ALIGN float a[3][lanes];
  for (std::size_t i = 0; i < lanes; ++i) {
    const std::size_t j = std::min(i, count - 1);
    a[0][i] = x[j], a[1][i] = y[j], a[2][i] = z[j];
  }
  return {load(a[0]), load(a[1]), load(a[2])};
}

void distances_of(const FieldData& field, const float* x, const float* y, const float* z,
                  std::size_t count, float* out) {
  Sampler sampler(field);
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t n = std::min<std::size_t>(lanes, count - i);
    HWY_ALIGN float d[lanes];
    store(sampler.distance(points_at(x + i, y + i, z + i, n), all_lanes, 1e30f), d);
    std::copy(d, d + n, out + i);
  }
}

void normals_of(const FieldData& field, const Points& points, const float* step, std::size_t count,
                Points& out) {
  Sampler sampler(field);
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t n = std::min<std::size_t>(lanes, count - i);
    HWY_ALIGN float steps[lanes], normal[3][lanes];
    for (std::size_t l = 0; l < lanes; ++l) steps[l] = step[i + std::min(l, n - 1)];
    const P found = normal_at(sampler, field,
                              points_at(&points.x[i], &points.y[i], &points.z[i], n), load(steps));
    store(found.x, normal[0]), store(found.y, normal[1]), store(found.z, normal[2]);
    std::copy_n(normal[0], n, &out.x[i]), std::copy_n(normal[1], n, &out.y[i]);
    std::copy_n(normal[2], n, &out.z[i]);
  }
}

void surfaces_of(const FieldData& field, const MeetingPoint* met, std::size_t count,
                 const PointError& error, Vec3* positions, Vec3* normals) {
  Sampler sampler(field);
  for (std::size_t i = 0; i < count; i += lanes) {
    SurfaceLanes surface(met + i, std::min<std::size_t>(lanes, count - i));
    surface.find_normals(sampler, field);
    surface.put_onto_surface(sampler, field, error);
    surface.write(positions + i, normals + i);
  }
}

void ranges_of(const Tape& tape, const Word* code, std::size_t count, const Cells& cells,
               Ranges* out) {
  const P p{load(cells.x), load(cells.y), load(cells.z)};
  const F radius = load(cells.radius);
  const F size = max(abs(p.x), max(abs(p.y), abs(p.z)));
  IntervalMachine machine(radius, (size + radius) * 1e-5f, out);
  run(tape, machine, code, count, p, slots_for<Interval>(tape));
}

void owners_of(const FieldData& field, const float* x, const float* y, const float* z,
               std::size_t count, std::uint32_t* surface, std::uint8_t* blended) {
  find_owners(field, points_at(x, y, z, count), count, surface, blended);
}

void trace_rays(const FieldData& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
                int steps) {
  Tracer<false> tracer(out);
  march(field, rays, steps, tracer);
}

void occluded_rays(const FieldData& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
                   int steps) {
  Tracer<true> tracer(out);
  march(field, rays, steps, tracer);
}

template <ShadowMarch Kind>
void shadow_rays(const FieldData& field, std::span<const ShadowRay> rays,
                 std::span<ShadowResult> out, const ShadowOptions& options) {
  Shadow<Kind> method(options, out);
  march(field, rays, options.steps, method);
}

void shadow_of(const FieldData& field, ShadowMarch kind, std::span<const ShadowRay> rays,
               std::span<ShadowResult> out, const ShadowOptions& options) {
  switch (kind) {
    case ShadowMarch::classic:
      return shadow_rays<ShadowMarch::classic>(field, rays, out, options);
    case ShadowMarch::improved:
      return shadow_rays<ShadowMarch::improved>(field, rays, out, options);
    case ShadowMarch::inner:
      return shadow_rays<ShadowMarch::inner>(field, rays, out, options);
    case ShadowMarch::blog:
      return shadow_rays<ShadowMarch::blog>(field, rays, out, options);
    case ShadowMarch::hard:
      return shadow_rays<ShadowMarch::hard>(field, rays, out, options);
    case ShadowMarch::inner_abs:
      return shadow_rays<ShadowMarch::inner_abs>(field, rays, out, options);
  }
}

// Where the free sphere no longer holds the cone: t grows until h falls to its radius there.
void clear_ways_of(const FieldData& field, std::span<const MarchRay> axes, float slope,
                   std::span<float> out) {
  Sampler sampler(field);
  for (std::size_t first = 0; first < axes.size(); first += lanes) {
    const std::size_t n = std::min<std::size_t>(lanes, axes.size() - first);
    HWY_ALIGN float a[8][lanes];
    for (std::size_t i = 0; i < lanes; ++i) {
      const MarchRay& ray = axes[first + std::min(i, n - 1)];
      for (int k = 0; k < 3; ++k) a[k][i] = ray.origin[k], a[3 + k][i] = ray.direction[k];
      a[6][i] = ray.t_min, a[7][i] = ray.t_max;
    }
    const P o{load(a[0]), load(a[1]), load(a[2])}, d{load(a[3]), load(a[4]), load(a[5])};
    F t = load(a[6]);
    const F t_max = load(a[7]);
    F most = 1e30f;
    std::uint32_t active = all_lanes;
    const F stretch = std::sqrt(1 + slope * slope);
    for (int i = 0; i < 64 && active; ++i) {
      const P p{mad(t, d.x, o.x), mad(t, d.y, o.y), mad(t, d.z, o.z)};
      const F h = sampler.distance(p, active, most);
      // The sphere of radius h about t holds the cone's cap up to t + s with
      // s = (h − slope t) / (stretch (1 + slope)), and more than that.
      const F s = (h - slope * t) / (stretch * (1 + slope));
      const M moves = (s > F(1e-3f) * t) & (t < t_max) & mask_of(active);
      const F next = select(moves, min(t + s, t_max), t);
      most = most_after(field, h, next - t, p);
      t = next;
      active = bits(moves);
    }
    HWY_ALIGN float way[lanes];
    store(t, way);
    std::copy(way, way + n, out.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace penumbra::sdf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace penumbra::sdf {

HWY_EXPORT(distances_of);
HWY_EXPORT(normals_of);
HWY_EXPORT(surfaces_of);
HWY_EXPORT(ranges_of);
HWY_EXPORT(owners_of);
HWY_EXPORT(trace_rays);
HWY_EXPORT(occluded_rays);
HWY_EXPORT(shadow_of);
HWY_EXPORT(clear_ways_of);

void distances(const FieldData& field, const float* x, const float* y, const float* z,
               std::size_t count, float* out) {
  HWY_DYNAMIC_DISPATCH(distances_of)(field, x, y, z, count, out);
}
void normals(const FieldData& field, const Points& points, const float* step, std::size_t count,
             Points& out) {
  HWY_DYNAMIC_DISPATCH(normals_of)(field, points, step, count, out);
}
void surfaces(const Field& field, std::span<const MeetingPoint> met, const PointError& error,
              std::span<Vec3> positions, std::span<Vec3> normals) {
  HWY_DYNAMIC_DISPATCH(surfaces_of)
  (field.data(), met.data(), met.size(), error, positions.data(), normals.data());
}
void owners(const FieldData& field, const float* x, const float* y, const float* z,
            std::size_t count, std::uint32_t* surface, std::uint8_t* blended) {
  HWY_DYNAMIC_DISPATCH(owners_of)(field, x, y, z, count, surface, blended);
}
void ranges_in(const Tape& tape, std::span<const Word> code, const Cells& cells,
               std::vector<Ranges>& ranges) {
  ranges.resize(code.size());
  HWY_DYNAMIC_DISPATCH(ranges_of)(tape, code.data(), code.size(), cells, ranges.data());
}
void trace(const Field& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
           const TraceOptions& options) {
  HWY_DYNAMIC_DISPATCH(trace_rays)(field.data(), rays, out, options.steps);
}
void occluded(const Field& field, std::span<const MarchRay> rays, std::span<MarchHit> out,
              const TraceOptions& options) {
  HWY_DYNAMIC_DISPATCH(occluded_rays)(field.data(), rays, out, options.steps);
}
void shadow(const Field& field, ShadowMarch march, std::span<const ShadowRay> rays,
            std::span<ShadowResult> out, const ShadowOptions& options) {
  HWY_DYNAMIC_DISPATCH(shadow_of)(field.data(), march, rays, out, options);
}
void clear_ways(const Field& field, std::span<const MarchRay> axes, float slope,
                std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(clear_ways_of)(field.data(), axes, slope, out);
}

}  // namespace penumbra::sdf
#endif
