// A composed shader as a program, with what never changes while it draws.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "gl/program.h"
#include "gl/target.h"
#include "render/glsl/compose.h"

namespace penumbra {

/// What programs look up in textures: the distances to a field's meshes, the faces of mesh lights.
/// Programs that take them must not outlive them.
class SceneTextures {
 public:
  /// Throws InputError if they are more than a texture holds.
  SceneTextures(const FieldText& field, const ShaderLights& lights, int longest_side);
  void give(gl::Program& program) const;

 private:
  std::optional<gl::Texture> meshes_, lights_, images_, masks_;
};

/// What the program is told of the whole picture.
struct ShaderView {
  int width = 0, height = 0;  ///< pixels
  float time = 0;             ///< iTime, seconds
};

/// Compiles it. Throws InputError with line and column of the person's file, or without a place if
/// the fault is where our text calls theirs; WorkError if it is ours alone.
std::unique_ptr<gl::Program> field_program(const FieldText& field, const ShaderLights& lights,
                                           const ShadowOptions& shadows, ShaderTask task,
                                           const ShaderView& view);

/// Sets the lights that the program looks at now; at most lights_at_a_time.
void set_lights(gl::Program& program, std::span<const ShaderLight> lights);

/// What a pixel's notes say (pnb_notes in trace.glsl).
struct PixelNotes {
  bool inside = false, cut = false, unfinished = false;
  std::uint64_t steps = 0;

  explicit PixelNotes(float notes);
};

/// Loops were ended by the driver in so many of the samples.
[[noreturn]] void refuse_cut_loops(const FieldText& field, const std::string& renderer,
                                   std::uint64_t cut, std::uint64_t samples);

}  // namespace penumbra
