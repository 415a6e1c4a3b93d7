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
  SamplePattern unturned = samples_.pattern(0);
  const Vec2* squares = samples_.table(0);
  // The disks of all tables follow one another as their squares do.
  const Vec2* disks =
      unturned.disk - static_cast<std::ptrdiff_t>(unturned.table) * samples_.count();
  for (int i = 0; i < samples_.count() * samples_.table_count(); ++i) {
    float* texel = &texels[static_cast<std::size_t>(i) * 4];
    texel[0] = squares[i].x, texel[1] = squares[i].y;
    texel[2] = disks[i].x, texel[3] = disks[i].y;
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
