// Programs that are run once for every pixel of a rectangle, or of triangles.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/compile_log.h"

namespace penumbra::gl {

/// The driver has refused a shader.
class CompileError : public std::runtime_error {
 public:
  explicit CompileError(const std::string& log)
      : std::runtime_error(log), messages_(parse_compile_log(log)) {}
  /// The driver's complaints; empty if they could not be read: then what() is its whole log.
  const std::vector<CompileMessage>& messages() const { return messages_; }

 private:
  std::vector<CompileMessage> messages_;
};

/// How a program's output meets what the target holds.
enum class Combine { replace, add, set_bits };

/// A program of one fragment shader; needs the Context that it was made under.
class Program {
 public:
  /// `fragment` is a whole GLSL ES 3.00 text. Throws CompileError.
  explicit Program(const std::string& fragment);
  /// With a vertex shader of its own, for draw_triangles. Throws CompileError.
  Program(const std::string& vertex, const std::string& fragment);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Uniforms of names that the program does not use are ignored.
  void set(const char* name, int value);
  void set(const char* name, float value);
  void set(const char* name, float x, float y);
  void set(const char* name, float x, float y, float z);
  /// Groups of four floats.
  void set_vec4s(const char* name, std::span<const float> values);

  /// Runs it for every pixel of the current Target's lower left width × height and waits until that
  /// is done.
  void draw(int width, int height, Combine combine = Combine::replace);
  /// Draws triangles into the current target's lower left width × height, `instances` times. A
  /// vertex is `attributes[i]` floats for location i, one after the other. Profile::core.
  void draw_triangles(const Buffer& vertices, std::span<const int> attributes, int count,
                      int instances, int width, int height, Combine combine);

 private:
  void link(unsigned vertex, unsigned fragment);
  int location(const char* name) const;
  unsigned program_ = 0, vertices_ = 0;
};

}  // namespace penumbra::gl
