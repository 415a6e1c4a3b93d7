// What reaches a scene's surfaces, light by light, as textures in memory that a picture is shaded
// from (Heckbert and Herf 1997, section 3: radiance textures, but for the materials).
#pragma once

#include <memory>
#include <vector>

#include "bake/baked_irradiance.h"
#include "bake/plan.h"
#include "base/progress.h"
#include "render/known_light.h"
#include "render/material_lookup.h"

namespace penumbra::bake {

struct LightTextureOptions {
  int supersample = 1;             ///< points along each side of a texel
  bool visible_fractions = false;  ///< too
};

/// Immutable once built; thread-safe. Textures are read bilinearly.
class LightTextures final : public KnownLight {
 public:
  /// `scene` is of triangles (triangulate.h), and `irradiance` knows its world. Keeps references to
  /// scene and plan.
  LightTextures(const Scene& scene, const Plan& plan, const BakedIrradiance& irradiance,
                const LightTextureOptions& options, Progress& progress);
  ~LightTextures() override;

  void irradiances(std::size_t light, std::span<const TilePoint> points,
                   std::span<float> out) const override;
  void visible_fractions(std::size_t light, std::span<const TilePoint> points,
                         std::span<float> out) const override;
  bool has_visible_fractions() const { return !fractions_.empty(); }

 private:
  struct Chart;
  using Texels = std::vector<float>;  ///< of one chart and light; negative where none is known
  void map_triangles();
  /// The chart that shows a point, or none; where in it, in texels.
  const Chart* find(const TilePoint& point, Vec2& at) const;
  void look_up(const std::vector<Texels>& textures, std::size_t light,
               std::span<const TilePoint> points, std::span<float> out) const;

  const Scene& scene_;
  const Plan& plan_;
  std::vector<Chart> charts_;
  /// By instance and side, a chart for each triangle; empty where the side has none.
  std::vector<std::vector<std::uint32_t>> chart_of_[2];
  std::vector<Texels> irradiances_, fractions_;  ///< by chart, then light
};

}  // namespace penumbra::bake
