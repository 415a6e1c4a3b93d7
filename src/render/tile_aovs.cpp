#include "render/tile_aovs.h"

namespace penumbra {

TileAovs::TileAovs(const RenderSetup& setup, const Tile& tile, std::vector<float>& squared_errors,
                   RenderResult& result)
    : options_(setup.options),
      tile_(tile),
      light_count_(setup.lights.size()),
      squared_errors_(squared_errors),
      hits_(static_cast<std::size_t>(tile.pixel_count())),
      result_(result) {
  if (options_.want_error) squared_errors_.assign(light_count_ * hits_.size(), 0.0f);
}

float* TileAovs::at(Image& image, std::uint32_t pixel) const {
  const int i = static_cast<int>(pixel);
  return image.at(tile_.x0 + i % tile_.width(), tile_.y0 + i / tile_.width());
}

void TileAovs::met(std::span<const TilePoint> points) {
  for (const TilePoint& p : points) {
    ++hits_[p.pixel];
    if (options_.want_depth) *at(result_.depth, p.pixel) += p.t;
    if (options_.want_normal) {
      float* sum = at(result_.normal, p.pixel);
      for (int c = 0; c < 3; ++c) sum[c] += p.shading.normal[c];
    }
  }
}

void TileAovs::arrived(std::size_t light, std::span<const TilePoint> points,
                       std::span<const LightArrival> arrivals) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Visibility& v = arrivals[i].visibility;
    if (options_.want_visibility) *at(result_.visibility[light], points[i].pixel) += v.fraction;
    if (options_.want_steps) *at(result_.steps, points[i].pixel) += static_cast<float>(v.steps);
    if (options_.want_error)
      squared_errors_[light * hits_.size() + points[i].pixel] +=
          v.standard_error * v.standard_error;
  }
}

void TileAovs::finish_pixel(std::uint32_t pixel) {
  const float spp = static_cast<float>(options_.spp), hits = static_cast<float>(hits_[pixel]);
  if (options_.want_visibility)
    for (Image& image : result_.visibility) {
      float* v = at(image, pixel);
      *v = (*v + spp - hits) / spp;
    }
  if (options_.want_depth) {
    float* depth = at(result_.depth, pixel);
    *depth = hits > 0 ? *depth / hits : INFINITY;
  }
  if (options_.want_normal) {
    float* n = at(result_.normal, pixel);
    const float size = length(Vec3{n[0], n[1], n[2]});
    for (int c = 0; c < 3; ++c) n[c] = size > 0 ? n[c] / size : 0;
  }
  if (options_.want_steps && hits > 0) *at(result_.steps, pixel) /= hits;
  if (options_.want_error) {
    float worst = 0;
    for (std::size_t light = 0; light < light_count_; ++light)
      worst = std::max(worst, squared_errors_[light * hits_.size() + pixel]);
    *at(result_.error, pixel) = std::sqrt(worst) / spp;
  }
}

void TileAovs::finish() {
  if (!wants_arrivals() && !options_.want_depth && !options_.want_normal) return;
  for (std::uint32_t pixel = 0; pixel < hits_.size(); ++pixel) finish_pixel(pixel);
}

}  // namespace penumbra
