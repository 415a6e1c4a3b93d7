#include "bake/baked_irradiance.h"

#include <algorithm>

#include "bake/cost.h"
#include "bake/gl/gl_baker.h"
#include "bake/raster_baker.h"
#include "bake/ray_baker.h"
#include "base/cancel.h"
#include "base/parallel.h"

namespace penumbra::bake {
namespace {

constexpr std::size_t texels_a_piece = 256, points_a_look = 16384;

float instance_scale(const BakeOptions& options, std::uint32_t instance) {
  return instance < options.instance_scale.size() ? options.instance_scale[instance] : 1.0f;
}

ReceiverPatch patch_of(const PlanarChart& c, const BakeOptions& options,
                       const SampleSet& set = {}) {
  return {{c.base, c.base + c.edge_x, c.base + c.edge_x + c.edge_y, c.base + c.edge_y},
          c.normal,
          instance_scale(options, c.instance) * set.share,
          set.number};
}

ReceiverPatch patch_of(const Receiver& r, float scale, const SampleSet& set) {
  return {
      {r.position, r.position, r.position, r.position}, r.normal, scale * set.share, set.number};
}

/// True if all of a light's samples are on the lit side of the chart's plane.
bool is_before(const SampledLight& light, const PlanarChart& chart) {
  return std::ranges::all_of(light.samples, [&](const LightSample& s) {
    const Vec3 to = light.kind == EmitterKind::direction ? s.position : s.position - chart.base;
    return dot(to, chart.normal) > 0;
  });
}

/// Per unit emission, by the light's samples.
float unshadowed(const SampledLight& light, const Vec3& p, const Vec3& n) {
  if (light.is_ratio()) return whole_irradiance_of(light, p, n) * light.spot_part(p);
  float sum = 0;
  for (const LightSample& s : light.samples) sum += irradiance_of(light, s, p, n);
  return sum * light.spot_part(p);
}

/// Calls body(first, last) for pieces of [0, count).
template <class Body>
void in_pieces(std::size_t count, const Body& body) {
  const std::size_t pieces = (count + texels_a_piece - 1) / texels_a_piece;
  const auto piece = [&](std::size_t k) {
    body(k * texels_a_piece, std::min(count, (k + 1) * texels_a_piece));
  };
  if (pieces == 1)
    piece(0);
  else
    parallel_for(pieces, piece);
}

/// Calls body(texel, receiver) for all texels of a chart.
template <class Body>
void for_texels(const PlanarChart& chart, const Body& body) {
  const auto width = static_cast<std::size_t>(chart.width);
  const auto count = width * static_cast<std::size_t>(chart.height);
  in_pieces(count, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t row = i / width;
      const Vec3 p = chart.texel(static_cast<float>(i - row * width), static_cast<float>(row));
      body(i, Receiver{p, chart.normal});
    }
  });
}

}  // namespace

struct BakedIrradiance::Parts {
  Parts(const World& w, const BakeOptions& o)
      : world(w), options(o), lights(w.scene()), sampler(lights, options), rays(w) {
    if (options.device == BakeDevice::rays) return;
    occluders = std::make_unique<Occluders>(w.scene(), options.conversions);
    if (options.device == BakeDevice::gl)
      gl = std::make_unique<GlBaker>(*occluders);
    else
      raster = std::make_unique<RasterBaker>(*occluders);
    if (options.device == BakeDevice::automatic) gl = GlBaker::on_graphics_processor(*occluders);
  }

  Way way(const PlanarChart& chart, std::span<const SampledLight> sampled) const {
    switch (options.device) {
      case BakeDevice::rays:
        return Way::rays;
      case BakeDevice::cpu:
        return Way::raster;
      case BakeDevice::gl:
        return Way::gl;
      case BakeDevice::automatic:
        break;
    }
    const Tile whole(chart, 0, 0, chart.width, chart.height);
    return cheapest_way(*occluders, whole, sampled, gl != nullptr, thread_count());
  }

  void irradiance(const PlanarChart& chart, std::span<const SampledLight> sampled,
                  std::span<Vec3> out) const {
    const Way chosen = way(chart, sampled);
    if (chosen == Way::gl) return gl->irradiance(chart, sampled, out);
    if (chosen == Way::raster) return raster->irradiance(chart, sampled, out);
    for_texels(chart, [&](std::size_t i, const Receiver& texel) {
      out[i] = {};
      for (const SampledLight& light : sampled)
        out[i] += light.emission * rays.light(texel, light).irradiance;
    });
  }

  /// Calls body(number, receiver, patch) for all points.
  template <class Body>
  void for_points(std::span<const SurfacePoint> points, const SampleSet& set,
                  const Body& body) const {
    in_pieces(points.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        throw_if_cancelled();
        const Receiver r = rays.receiver(points[i]);
        body(i, r, patch_of(r, instance_scale(options, points[i].instance), set));
      }
    });
  }

  const World& world;
  BakeOptions options;
  LightViews lights;
  LightSampler sampler;
  RayBaker rays;
  std::unique_ptr<Occluders> occluders;  ///< null for rays
  std::unique_ptr<RasterBaker> raster;   ///< null for rays and gl
  std::unique_ptr<GlBaker> gl;           ///< for gl, and for auto on a graphics processor
};

BakedIrradiance::BakedIrradiance(const World& world, const BakeOptions& options)
    : parts_(std::make_unique<Parts>(world, options)) {}

BakedIrradiance::~BakedIrradiance() = default;

const BakeOptions& BakedIrradiance::options() const { return parts_->options; }

std::vector<int> BakedIrradiance::sample_counts(const PlanarChart& chart,
                                                const SampleSet& set) const {
  std::vector<int> counts(parts_->world.scene().lights.size());
  for (std::size_t l = 0; l < counts.size(); ++l)
    counts[l] = parts_->sampler.count(l, patch_of(chart, parts_->options, set));
  return counts;
}

void BakedIrradiance::of_chart(const PlanarChart& chart, const SampleSet& set,
                               std::span<Vec3> out) const {
  const Parts& p = *parts_;
  std::vector<SampledLight> lights;
  for (std::size_t l = 0; l < p.world.scene().lights.size(); ++l)
    lights.push_back(p.sampler.sample(l, patch_of(chart, p.options, set)));
  p.irradiance(chart, lights, out);
}

void BakedIrradiance::of_points(std::span<const SurfacePoint> points, const SampleSet& set,
                                std::span<Vec3> out) const {
  const Parts& p = *parts_;
  p.for_points(points, set, [&](std::size_t i, const Receiver& r, const ReceiverPatch& patch) {
    out[i] = {};
    for (std::size_t l = 0; l < p.world.scene().lights.size(); ++l) {
      const SampledLight light = p.sampler.sample(l, patch);
      out[i] += light.emission * p.rays.light(r, light).irradiance;
    }
  });
}

void BakedIrradiance::of_curved(const PlanarChart& plane, std::span<const SurfacePoint> points,
                                std::span<const std::size_t> texels, const SampleSet& set,
                                std::span<Vec3> out) const {
  const Parts& p = *parts_;
  if (p.options.curved == CurvedShadows::rays) {
    for (std::size_t first = 0; first < points.size(); first += points_a_look) {
      throw_if_cancelled();
      const std::size_t count = std::min(points_a_look, points.size() - first);
      of_points(points.subspan(first, count), set, out.subspan(first, count));
    }
    return;
  }
  std::ranges::fill(out, Vec3());
  std::vector<Vec3> arrives(static_cast<std::size_t>(plane.width) *
                            static_cast<std::size_t>(plane.height));
  for (std::size_t l = 0; l < p.world.scene().lights.size(); ++l) {
    throw_if_cancelled();
    const ReceiverPatch patch = patch_of(plane, p.options, set);
    SampledLight light = p.sampler.sample(l, patch, true);
    const Vec3 emission = light.emission;
    const bool on_plane = is_before(light, plane);
    if (on_plane) {
      light.emission = Vec3(1);
      p.irradiance(plane, std::span(&light, 1), arrives);
    }
    p.for_points(points, set, [&](std::size_t i, const Receiver& r, const ReceiverPatch& own) {
      if (!on_plane) {
        out[i] += emission * p.rays.light(r, p.sampler.sample(l, own)).irradiance;
        return;
      }
      const std::size_t row = texels[i] / static_cast<std::size_t>(plane.width);
      const Vec3 below =
          plane.texel(static_cast<float>(texels[i] - row * static_cast<std::size_t>(plane.width)),
                      static_cast<float>(row));
      const float all = unshadowed(light, below, plane.normal);
      const float part = all > 0 ? std::min(arrives[texels[i]].x / all, 1.0f) : 0.0f;
      if (part > 0) out[i] += emission * (part * unshadowed(light, r.position, r.normal));
    });
  }
}

void BakedIrradiance::unit_irradiances(const PlanarChart& chart, std::size_t light,
                                       std::span<float> out) const {
  const Parts& p = *parts_;
  SampledLight sampled = p.sampler.sample(light, patch_of(chart, p.options));
  sampled.emission = Vec3(1);
  std::vector<Vec3> all(out.size());
  p.irradiance(chart, std::span(&sampled, 1), all);
  std::ranges::transform(all, out.begin(), [](const Vec3& e) { return e.x; });
}

void BakedIrradiance::unit_irradiances(std::span<const SurfacePoint> points, std::size_t light,
                                       std::span<float> out) const {
  const Parts& p = *parts_;
  p.for_points(points, {}, [&](std::size_t i, const Receiver& r, const ReceiverPatch& patch) {
    out[i] = p.rays.light(r, p.sampler.sample(light, patch)).irradiance;
  });
}

void BakedIrradiance::lit_parts(const PlanarChart& chart, std::size_t light,
                                std::span<float> out) const {
  const Parts& p = *parts_;
  const SampledLight sampled = p.sampler.sample(light, patch_of(chart, p.options));
  const Way way = p.way(chart, std::span(&sampled, 1));
  if (way == Way::gl) return p.gl->fractions(chart, sampled, BakeQuantity::lit_part, out);
  if (way == Way::raster) return p.raster->fractions(chart, sampled, BakeQuantity::lit_part, out);
  for_texels(chart, [&](std::size_t i, const Receiver& texel) {
    out[i] = p.rays.light(texel, sampled).lit_part;
  });
}

void BakedIrradiance::lit_parts(std::span<const SurfacePoint> points, std::size_t light,
                                std::span<float> out) const {
  const Parts& p = *parts_;
  p.for_points(points, {}, [&](std::size_t i, const Receiver& r, const ReceiverPatch& patch) {
    out[i] = p.rays.light(r, p.sampler.sample(light, patch)).lit_part;
  });
}

std::vector<SampledLight> BakedIrradiance::sampled_lights(const PlanarChart& chart,
                                                          bool all) const {
  const Parts& p = *parts_;
  std::vector<SampledLight> lights;
  for (std::size_t l = 0; l < p.world.scene().lights.size(); ++l)
    lights.push_back(p.sampler.sample(l, patch_of(chart, p.options), all));
  return lights;
}

void BakedIrradiance::visible_samples(const PlanarChart& chart, const SampledLight& light,
                                      SampleBits& bits) const {
  const Parts& p = *parts_;
  if (p.raster && p.way(chart, std::span(&light, 1)) != Way::rays)
    return p.raster->visible_samples(chart, light, bits);
  const auto width = static_cast<std::size_t>(chart.width);
  std::vector<std::uint8_t> row(width * light.samples.size());
  for (int j = 0; j < chart.height; ++j) {
    throw_if_cancelled();
    in_pieces(width, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        p.rays.visible_samples(
            {chart.texel(static_cast<float>(i), static_cast<float>(j)), chart.normal}, light,
            std::span(row).subspan(i * light.samples.size(), light.samples.size()));
    });
    for (std::size_t k = 0; k < row.size(); ++k)
      bits.set(static_cast<std::size_t>(j) * width + k / light.samples.size(),
               k % light.samples.size(), row[k] != 0);
  }
}

void BakedIrradiance::visible_samples(std::span<const SurfacePoint> points,
                                      const SampledLight& light,
                                      std::span<std::uint8_t> out) const {
  const Parts& p = *parts_;
  const std::size_t n = light.samples.size();
  in_pieces(points.size(), [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      p.rays.visible_samples(p.rays.receiver(points[i]), light, out.subspan(i * n, n));
  });
}

void BakedIrradiance::visible_fractions(const PlanarChart& chart, std::size_t light,
                                        std::span<float> out) const {
  const Parts& p = *parts_;
  const SampledLight sampled = p.sampler.sample(light, patch_of(chart, p.options), true);
  const Way way = p.way(chart, std::span(&sampled, 1));
  if (way == Way::gl) return p.gl->visible_fractions(chart, sampled, out);
  if (way == Way::raster) return p.raster->visible_fractions(chart, sampled, out);
  for_texels(chart, [&](std::size_t i, const Receiver& texel) {
    out[i] = p.rays.light(texel, sampled).fraction;
  });
}

void BakedIrradiance::visible_fractions(std::span<const SurfacePoint> points, std::size_t light,
                                        std::span<float> out) const {
  const Parts& p = *parts_;
  p.for_points(points, {}, [&](std::size_t i, const Receiver& r, const ReceiverPatch& patch) {
    out[i] = p.rays.light(r, p.sampler.sample(light, patch, true)).fraction;
  });
}

}  // namespace penumbra::bake
