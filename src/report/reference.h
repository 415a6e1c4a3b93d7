// The truth that the methods are compared with: visible fractions at the centres of a picture's
// pixels, and the picture itself.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "base/progress.h"
#include "image/image.h"
#include "render/render.h"
#include "report/reference_point.h"

namespace penumbra::report {

struct ReferenceOptions {
  int width = 0, height = 0;  ///< pixels
  int camera = 0;             ///< index into Scene::cameras
  float target = 0.002f;      ///< standard error of each visible fraction
  std::uint32_t seed = 0;
};

/// Row by row from the top left; by light, then pixel, where there are lights.
struct Reference {
  int width = 0, height = 0;
  std::size_t lights = 0;
  std::vector<std::uint8_t> surface;  ///< by pixel: 1 = its centre sees a surface
  std::vector<PointReference> at;     ///< by light, then pixel; undefined without a surface
  std::vector<std::uint8_t> tiles;    ///< 1 = done
  float exposure_ev = 0;              ///< that the picture asks for by itself
  Image color;                        ///< the picture, linear rgb radiance; empty until it is drawn
  double seconds = 0;                 ///< that all this took, over all sessions
  std::uint64_t rays = 0;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * height; }
  const PointReference& point(std::size_t light, std::size_t pixel) const {
    return at[light * pixels() + pixel];
  }
  bool complete() const;
};

/// What became of the target.
struct ReferenceQuality {
  double share_within = 0;  ///< of the pixels with a surface: standard error below the target for
                            ///< every light
  double points_mean = 0;   ///< a pixel and light
  std::uint32_t points_most = 0;
};
ReferenceQuality quality_of(const Reference& reference, float target);

/// An empty one of that size.
Reference empty_reference(const ReferenceOptions& options, std::size_t lights);

/// What the pixel's centre sees: a receiver for each pixel that sees a surface, in order of
/// pixels. Pixels from `begin` to `end`.
struct PixelReceiver {
  std::size_t pixel = 0;
  Receiver receiver;
};
std::vector<PixelReceiver> receivers_of(const World& world, const ReferenceOptions& options);

/// Finds the visible fractions of the tiles that are not done. `save` is called from time to time
/// with what is there so far, and once more before an exception (Cancelled, say) leaves.
void complete_reference(const World& world, const ReferenceOptions& options, Reference& reference,
                        const std::function<void(const Reference&)>& save, Progress& progress);

}  // namespace penumbra::report
