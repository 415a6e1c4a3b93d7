// What the draws of a band give, added up into the picture.
#pragma once

#include <vector>

#include "gl/target.h"
#include "render/gl/draws.h"
#include "render/gl/field_program.h"
#include "render/render.h"

namespace penumbra {

/// Sums over the samples of the pixels of one band of rows. Begin a band, add every draw of every
/// sample, finish it.
class BandSums {
 public:
  BandSums(const RenderOptions& options, RenderResult& result);

  /// Rows are counted from the bottom of the picture.
  void begin(int from_row, int rows);
  /// Reads what a draw has left in the target.
  void add(const PictureDraw& draw, const gl::Target& target);
  void finish();

  std::uint64_t cut() const { return cut_; }  ///< samples of the band whose loops were cut
  std::uint64_t samples() const { return samples_; }
  bool eye_is_inside() const { return inside_; }

 private:
  struct PointSums {
    Vec3 diffuse, glossy;
    float diffuse_all = 0, glossy_all = 0, seen = 0;
  };

  std::size_t pixel_count() const { return static_cast<std::size_t>(options_.width) * rows_; }
  float* at(Image& image, std::size_t pixel) const;
  void note(float notes, bool base);
  void add_color(std::size_t pixel, const Vec3& radiance);
  void add_view(std::size_t pixel, const float* depth_and_normal, bool met);
  void add_points(const PictureDraw& draw, const std::vector<float>& diffuse,
                  const std::vector<float>& glossy, const std::vector<float>& seen,
                  const std::vector<float>& notes);

  const RenderOptions& options_;
  RenderResult& result_;
  int from_ = 0, rows_ = 0;
  std::uint64_t cut_ = 0, samples_ = 0;
  bool inside_ = false;
  std::uint64_t steps_ = 0, unfinished_ = 0;
  std::vector<int> hits_;
  std::vector<PointSums> points_;
};

}  // namespace penumbra
