#include "render/gl/band_sums.h"

#include <cmath>

namespace penumbra {

BandSums::BandSums(const RenderOptions& options, RenderResult& result)
    : options_(options), result_(result) {}

float* BandSums::at(Image& image, std::size_t pixel) const {
  const auto width = static_cast<std::size_t>(options_.width);
  const int row = from_ + static_cast<int>(pixel / width);
  return image.at(static_cast<int>(pixel % width), options_.height - 1 - row);
}

void BandSums::begin(int from_row, int rows) {
  from_ = from_row, rows_ = rows;
  cut_ = samples_ = steps_ = unfinished_ = 0;
  hits_.assign(pixel_count(), 0);
  points_.assign(pixel_count(), {});
  const auto clear = [&](Image& image) {
    if (image.data.empty()) return;
    for (std::size_t i = 0; i < pixel_count(); ++i) std::fill_n(at(image, i), image.channels, 0.0f);
  };
  clear(result_.color), clear(result_.depth), clear(result_.normal), clear(result_.steps);
  for (Image& image : result_.visibility) clear(image);
}

void BandSums::note(float notes, bool base) {
  const PixelNotes n(notes);
  cut_ += n.cut;
  steps_ += n.steps;
  inside_ = inside_ || n.inside;
  unfinished_ += n.unfinished;
  samples_ += base;
}

void BandSums::add_color(std::size_t pixel, const Vec3& radiance) {
  const float share = 1 / static_cast<float>(options_.spp);
  float* rgb = at(result_.color, pixel);
  for (int c = 0; c < 3; ++c) rgb[c] += radiance[c] * share;
}

void BandSums::add_view(std::size_t pixel, const float* depth_and_normal, bool met) {
  if (!met) return;
  ++hits_[pixel];
  if (options_.want_depth) *at(result_.depth, pixel) += depth_and_normal[0];
  if (options_.want_normal)
    for (int c = 0; c < 3; ++c) at(result_.normal, pixel)[c] += depth_and_normal[1 + c];
}

void BandSums::add_points(const PictureDraw& draw, const std::vector<float>& diffuse,
                          const std::vector<float>& glossy, const std::vector<float>& seen,
                          const std::vector<float>& notes) {
  for (std::size_t i = 0; i < pixel_count(); ++i) {
    const float *d = &diffuse[4 * i], *g = &glossy[4 * i];
    PointSums& sums = points_[i];
    sums.diffuse += {d[0], d[1], d[2]}, sums.diffuse_all += d[3];
    sums.glossy += {g[0], g[1], g[2]}, sums.glossy_all += g[3];
    const bool met = notes[4 * i + 1] > 0;
    sums.seen = met ? sums.seen + seen[4 * i] : 1;
    if (!draw.last_of_points()) continue;
    if (sums.diffuse_all > 0) add_color(i, sums.diffuse / sums.diffuse_all);
    if (sums.glossy_all > 0) add_color(i, sums.glossy / sums.glossy_all);
    if (options_.want_visibility && draw.generation == 0)
      *at(result_.visibility[draw.light_from], i) += sums.seen;
    sums = {};
  }
}

void BandSums::add(const PictureDraw& draw, const gl::Target& target) {
  const bool layers = target.layer_count() > 1;
  const auto read = [&](int layer) { return target.read(layer, options_.width, rows_); };
  const std::vector<float> color = read(0);
  std::vector<float> view, seen, notes;
  if (layers) view = read(1), seen = read(2), notes = read(3);
  for (std::size_t i = 0; i < pixel_count(); ++i)
    note(layers ? notes[4 * i] : color[4 * i + 3], draw.base);
  if (draw.by_points()) return add_points(draw, color, view, seen, notes);
  for (std::size_t i = 0; i < pixel_count(); ++i) {
    add_color(i, {color[4 * i], color[4 * i + 1], color[4 * i + 2]});
    if (!layers) continue;
    if (draw.base) add_view(i, &view[4 * i], notes[4 * i + 1] > 0);
    if (options_.want_steps) *at(result_.steps, i) += notes[4 * i + 3];
    if (options_.want_visibility)
      for (std::size_t l = 0; l < draw.light_count; ++l)
        *at(result_.visibility[draw.light_from + l], i) += seen[4 * i + l];
  }
}

void BandSums::finish() {
  result_.stats.field_steps += steps_;
  result_.stats.unfinished += unfinished_;
  const float spp = static_cast<float>(options_.spp);
  for (std::size_t i = 0; i < pixel_count(); ++i) {
    const float hits = static_cast<float>(hits_[i]);
    for (Image& image : result_.visibility) *at(image, i) /= spp;
    if (options_.want_depth) {
      float* depth = at(result_.depth, i);
      *depth = hits > 0 ? *depth / hits : INFINITY;
    }
    if (options_.want_steps && hits > 0) *at(result_.steps, i) /= hits;
    if (options_.want_normal) {
      float* n = at(result_.normal, i);
      const float size = length(Vec3{n[0], n[1], n[2]});
      for (int c = 0; c < 3; ++c) n[c] = size > 0 ? n[c] / size : 0;
    }
  }
}

}  // namespace penumbra
