// OpenGL without a display.
#pragma once

#include <string>

namespace penumbra::gl {

enum class Profile {
  shaders,  ///< OpenGL ES 3.0, or OpenGL 4.3 core, which takes the same shaders
  core      ///< OpenGL 4.5 core
};

/// A context made through EGL without window or display, current to the thread that made it.
/// Graphics processors come before software; Mesa's surfaceless platform before the software
/// device.
///
/// Drivers start threads: a process that is to fork must do so before it makes one.
class Context {
 public:
  /// Throws WorkError if there is no driver, or none that draws into floats.
  explicit Context(Profile profile = Profile::shaders);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// The driver's name for what draws, as "llvmpipe (LLVM 15.0.6, 256 bits)".
  const std::string& renderer() const { return renderer_; }
  /// Longest side of a framebuffer or texture, texels.
  int longest_side() const { return longest_side_; }

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_;
  int longest_side_ = 0;
};

/// False for the names of drivers that draw on the processor: llvmpipe and its like.
bool is_graphics_processor(const std::string& renderer);
/// False where the system shows no graphics processor at all, so that none need be asked for.
bool may_have_graphics_processor();

}  // namespace penumbra::gl
