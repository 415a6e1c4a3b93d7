// Tiles of pictures that show distance fields alone, of plain diffuse materials: what the general
// renderer draws, to the same bits, without what such points never need (textures, mirrors, glossy
// lobes, layers of output).
#pragma once

#include <optional>

#include "geometry/solid_hits.h"
#include "render/tile_renderer.h"

namespace penumbra {

/// What a diffuse material reflects and emits.
struct DiffuseColor {
  Vec3 diffuse, emission;
  bool double_sided = true;
};

/// Immutable; thread-safe.
class FieldTiles {
 public:
  /// Empty where the picture needs the general renderer.
  static std::optional<FieldTiles> of(const RenderSetup& setup);

  /// render_tile() for such a picture.
  TileCounts render(const RenderSetup& setup, const Tile& tile, RenderResult& result) const;

 private:
  struct Points;
  /// Pixels of one sample, at most Points::at_once.
  void render_part(const RenderSetup& setup, const Tile& tile, int sample, unsigned first,
                   Points& points, RenderResult& result, TileCounts& counts) const;
  void add_light(const RenderSetup& setup, std::size_t light, Points& points,
                 ShadowCounts& counts) const;
  void set_color(const World& world, const SolidHits& hits, std::size_t i, DiffuseColor& out) const;

  std::vector<DiffuseColor> colors_;  ///< by material
};

}  // namespace penumbra
