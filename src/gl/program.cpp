#include "gl/program.h"

#include <epoxy/gl.h>

namespace penumbra::gl {
namespace {

constexpr const char* kVertex = R"(#version 300 es
void main() {  // one triangle that covers everything
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

template <class Get, class Log>
std::string log_of(unsigned object, Get get, Log read) {
  int size = 0;
  get(object, GL_INFO_LOG_LENGTH, &size);
  std::string log(static_cast<std::size_t>(size), '\0');
  if (size > 0) read(object, size, nullptr, log.data());
  return log;
}

// Deleted with its program.
unsigned compiled(unsigned type, const char* text) {
  const unsigned shader = glCreateShader(type);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  int fine = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &fine);
  if (fine) return shader;
  const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  throw CompileError(log);
}

}  // namespace

Program::Program(const std::string& fragment) {
  const unsigned pixels = compiled(GL_FRAGMENT_SHADER, fragment.c_str());
  const unsigned corners = compiled(GL_VERTEX_SHADER, kVertex);
  program_ = glCreateProgram();
  for (const unsigned shader : {corners, pixels}) {
    glAttachShader(program_, shader);
    glDeleteShader(shader);
  }
  glLinkProgram(program_);
  int fine = 0;
  glGetProgramiv(program_, GL_LINK_STATUS, &fine);
  if (!fine) {
    const std::string log = log_of(program_, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(program_);
    throw CompileError(log);
  }
  glGenVertexArrays(1, &vertices_);
}

Program::~Program() {
  glDeleteVertexArrays(1, &vertices_);
  glDeleteProgram(program_);
}

int Program::location(const char* name) const {
  glUseProgram(program_);
  return glGetUniformLocation(program_, name);
}

void Program::set(const char* name, int value) { glUniform1i(location(name), value); }
void Program::set(const char* name, float value) { glUniform1f(location(name), value); }
void Program::set(const char* name, float x, float y) { glUniform2f(location(name), x, y); }
void Program::set(const char* name, float x, float y, float z) {
  glUniform3f(location(name), x, y, z);
}
void Program::set_vec4s(const char* name, std::span<const float> values) {
  glUniform4fv(location(name), static_cast<int>(values.size() / 4), values.data());
}

void Program::draw(int width, int height) {
  glUseProgram(program_);
  glBindVertexArray(vertices_);
  glViewport(0, 0, width, height);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glFinish();
}

}  // namespace penumbra::gl
