// What a tile records beside colour: visible fractions, depth, normals, error.
#pragma once

#include <span>
#include <vector>

#include "render/tile_renderer.h"

namespace penumbra {

/// Sums over the samples of a tile's pixels, written into the result's images by finish().
/// `squared_errors` is reused memory.
class TileAovs : public ArrivalObserver {
 public:
  TileAovs(const RenderSetup& setup, const Tile& tile, std::vector<float>& squared_errors,
           RenderResult& result);

  bool wants_arrivals() const {
    return options_.want_visibility || options_.want_error || options_.want_steps;
  }
  /// The first surfaces that one sample of each pixel met.
  void met(std::span<const TilePoint> points);
  void arrived(std::size_t light, std::span<const TilePoint> points,
               std::span<const LightArrival> arrivals) override;
  void finish();

 private:
  float* at(Image& image, std::uint32_t pixel) const;
  void finish_pixel(std::uint32_t pixel);

  const RenderOptions& options_;
  const Tile tile_;
  std::size_t light_count_;
  std::vector<float>& squared_errors_;
  std::vector<int> hits_;  ///< by pixel: samples that met something
  RenderResult& result_;
};

}  // namespace penumbra
