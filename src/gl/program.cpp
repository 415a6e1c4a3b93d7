#include "gl/program.h"

#include <epoxy/gl.h>

namespace penumbra::gl {
namespace {

constexpr const char* kVertex = R"(
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

void begin(Combine combine) {
  if (combine == Combine::add) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
  }
  if (combine == Combine::set_bits) {
    glEnable(GL_COLOR_LOGIC_OP);
    glLogicOp(GL_OR);
  }
}

void end(Combine combine) {
  if (combine == Combine::add) glDisable(GL_BLEND);
  if (combine == Combine::set_bits) glDisable(GL_COLOR_LOGIC_OP);
}

}  // namespace

// The vertex shader is of the fragment shader's version.
Program::Program(const std::string& fragment)
    : Program(fragment.substr(0, fragment.find('\n')) + kVertex, fragment) {}

Program::Program(const std::string& vertex, const std::string& fragment) {
  const unsigned pixels = compiled(GL_FRAGMENT_SHADER, fragment.c_str());
  link(compiled(GL_VERTEX_SHADER, vertex.c_str()), pixels);
}

void Program::link(unsigned vertex, unsigned fragment) {
  program_ = glCreateProgram();
  for (const unsigned shader : {vertex, fragment}) {
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

void Program::draw(int width, int height, Combine combine) {
  glUseProgram(program_);
  glBindVertexArray(vertices_);
  glViewport(0, 0, width, height);
  begin(combine);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  end(combine);
  glFinish();
}

void Program::draw_triangles(const Buffer& vertices, std::span<const int> attributes, int count,
                             int instances, int width, int height, Combine combine) {
  glUseProgram(program_);
  glBindVertexArray(vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices.id());
  int floats = 0;
  for (const int size : attributes) floats += size;
  std::size_t offset = 0;
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    const auto location = static_cast<unsigned>(i);
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, attributes[i], GL_FLOAT, GL_FALSE,
                          floats * static_cast<int>(sizeof(float)),
                          reinterpret_cast<const void*>(offset * sizeof(float)));
    offset += static_cast<std::size_t>(attributes[i]);
  }
  glViewport(0, 0, width, height);
  begin(combine);
  glDrawArraysInstanced(GL_TRIANGLES, 0, 3 * count, instances);
  end(combine);
}

}  // namespace penumbra::gl
