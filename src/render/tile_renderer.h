// One tile of the picture, one sample of each pixel at a time.
#pragma once

#include "render/camera_rays.h"
#include "render/material_lookup.h"
#include "render/point_shader.h"
#include "render/render.h"

namespace penumbra {

/// What all tiles read.
struct RenderSetup {
  const World& world;
  const RenderOptions& options;
  const DirectLight& lights;
  const MaterialLookup& materials;
  const Shadows& shadows;
  const CameraRays& camera;
  Vec3 ambient;  ///< radiance
};

/// Pixels [x0, x1) × [y0, y1).
struct Tile {
  static constexpr int size = 32;
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int pixel_count() const { return width() * (y1 - y0); }
};

struct TileCounts {
  std::uint64_t unfinished_rays = 0;  ///< camera's and mirrors' that ran out of steps
  std::uint64_t blind_rays = 0;       ///< that began inside a distance field
  std::uint64_t primary_rays = 0, mirror_rays = 0;
  ShadowCounts shadows;
};

/// A ray that still has something to bring to its pixel.
struct TileRay {
  CameraRay beam;
  Vec3 throughput{1, 1, 1};
  std::uint32_t pixel = 0;
  std::uint64_t stream = 0;
};

/// Memory that is reused from tile to tile; one for a thread.
struct TileScratch {
  std::vector<TileRay> rays;
  std::vector<TilePoint> points;
  std::vector<Vec3> radiance;
  std::vector<float> squared_errors;  ///< by light and pixel of the tile
  PointShader shader;
};

/// Traces `rays` into `points`, in order, leaving out those that meet nothing. Returns how many of
/// these ran out of steps in a distance field.
std::uint64_t trace(const World& world, const MaterialLookup& materials,
                    std::span<const TileRay> rays, std::vector<TilePoint>& points);

/// Renders the tile into its pixels of `result`, whose images are of full size or, where not
/// wanted, empty.
TileCounts render_tile(const RenderSetup& setup, const Tile& tile, TileScratch& scratch,
                       RenderResult& result);

}  // namespace penumbra
