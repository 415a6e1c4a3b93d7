// Equation (1) of Heckbert and Herf (1997) by OpenGL: the samples' hard shadows as bits, added up.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "bake/gl/sample_pass.h"
#include "gl/bit_layers.h"
#include "gl/program.h"
#include "gl/target.h"

namespace penumbra::bake {

/// Needs the context, of Profile::core, that it was made under.
class PassDrawer {
 public:
  PassDrawer();

  /// Four floats a texel, row by row: the sum of the weights of samples that nothing hides, of all,
  /// and two zeros.
  std::vector<float> draw(const SamplePass& pass);

 private:
  void grow(int width, int height);
  void draw_word(const SamplePass& pass, int layer);

  gl::Program& weights(Falloff falloff);

  gl::Program triangles_, spheres_;
  std::array<std::unique_ptr<gl::Program>, 7> weights_;  ///< by Falloff
  gl::Buffer vertices_, uniforms_;
  std::unique_ptr<gl::BitLayers> bits_;
  std::unique_ptr<gl::Target> sums_;
};

}  // namespace penumbra::bake
