#include "render/gl/point_patterns.h"

#include <cmath>

namespace penumbra {
namespace {

constexpr int kRow = 1024;  // light_points.glsl looks points up in rows of that many
constexpr int kPatternUnit = 1, kPointUnit = 2;

int rows(const LightSamples& samples) {
  return (samples.count() * samples.table_count() + kRow - 1) / kRow;
}

}  // namespace

PointPatterns::PointPatterns(int count, std::uint32_t seed, int width, int height)
    : samples_(count, seed), points_(kRow, rows(samples_)), patterns_(width, height) {
  std::vector<float> texels(static_cast<std::size_t>(kRow) * rows(samples_) * 4);
  float* texel = texels.data();
  for (int t = 0; t < samples_.table_count(); ++t) {
    const SamplePattern table = samples_.table(t);
    for (int i = 0; i < samples_.count(); ++i, texel += 4) {
      texel[0] = table.square_x[i], texel[1] = table.square_y[i];
      texel[2] = table.disk_x[i], texel[3] = table.disk_y[i];
    }
  }
  points_.write(kRow, rows(samples_), texels);
}

void PointPatterns::set(gl::Program& program, std::size_t light, int width,
                        std::span<const std::uint64_t> streams) {
  texels_.clear();
  for (const std::uint64_t stream : streams) {
    const SamplePattern p = samples_.pattern(hash(stream, light));
    texels_.insert(texels_.end(), {static_cast<float>(p.table), std::atan2(p.sine, p.cosine),
                                   p.shift.x, p.shift.y});
  }
  patterns_.write(width, static_cast<int>(streams.size()) / width, texels_);
  patterns_.bind(kPatternUnit);
  points_.bind(kPointUnit);
  program.set("pnb_patterns", kPatternUnit);
  program.set("pnb_points", kPointUnit);
  program.set("pnb_points_in_table", samples_.count());
}

}  // namespace penumbra
