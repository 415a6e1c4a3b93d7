// The CPU's points of lights (light_samples.h) for shaders, so that both sample alike.
#pragma once

#include <cstdint>
#include <span>

#include "gl/program.h"
#include "gl/target.h"
#include "shadow/light_samples.h"

namespace penumbra {

class PointPatterns {
 public:
  /// `count` points a light; patterns for at most width × height pixels.
  PointPatterns(int count, std::uint32_t seed, int width, int height);

  int count() const { return samples_.count(); }
  /// Gives the program the patterns of the pixels of these streams, row by row from the bottom.
  void set(gl::Program& program, std::size_t light, int width,
           std::span<const std::uint64_t> streams);

 private:
  LightSamples samples_;
  gl::Texture points_, patterns_;
  std::vector<float> texels_;
};

}  // namespace penumbra
