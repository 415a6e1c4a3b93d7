#include "bake/gl/pass_drawer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <string>
#include <string_view>

namespace penumbra {
std::string_view bake_shader_text(std::string_view name);
}

namespace penumbra::bake {
namespace {

constexpr int hidden_unit = 1;

std::string shader(std::string_view name) { return std::string(bake_shader_text(name)); }

/// With a definition after its first line, the version.
std::string shader(std::string_view name, const std::string& definition) {
  std::string text = shader(name);
  return text.insert(text.find('\n') + 1, "#define " + definition + "\n");
}

void set(gl::Program& program, const char* name, const Vec3& v) {
  program.set(name, v.x, v.y, v.z);
}

/// As large as the uniform block, whose unused rest is zero.
template <class T>
void write_block(gl::Buffer& buffer, std::vector<T> entries, std::size_t count) {
  entries.resize(count);
  buffer.write(std::as_bytes(std::span(entries)));
  buffer.bind_uniforms(0);
}

}  // namespace

PassDrawer::PassDrawer()
    : triangles_(shader("project.vert.glsl"), shader("triangle.frag.glsl")),
      spheres_(shader("project.vert.glsl", "SPHERES"), shader("sphere.frag.glsl")) {}

/// One branch each: drivers on processors take all branches of a shader.
gl::Program& PassDrawer::weights(Falloff falloff) {
  const auto index = static_cast<std::size_t>(falloff);
  if (!weights_[index])
    weights_[index] = std::make_unique<gl::Program>(
        shader("weights.frag.glsl", "FALLOFF " + std::to_string(index)));
  return *weights_[index];
}

void PassDrawer::grow(int width, int height) {
  if (bits_ && bits_->width() >= width && bits_->height() >= height) return;
  const auto side = [](int now, int wanted) {
    return std::max(now, static_cast<int>(std::bit_ceil(static_cast<unsigned>(wanted))));
  };
  const int w = side(bits_ ? bits_->width() : 64, width);
  const int h = side(bits_ ? bits_->height() : 64, height);
  bits_ = std::make_unique<gl::BitLayers>(w, h, static_cast<int>(words_a_pass));
  sums_ = std::make_unique<gl::Target>(w, h, 1);
}

void PassDrawer::draw_word(const SamplePass& pass, int layer) {
  const WordPass& word = pass.words[static_cast<std::size_t>(layer)];
  if (word.words.empty())
    bits_->clear(layer, word.below, pass.width, pass.height);
  else
    bits_->write(layer, pass.width, pass.height, word.words);
  if (word.views.empty() || (word.triangles.empty() && word.spheres.empty())) return;
  bits_->use(layer);
  write_block(uniforms_, word.views, samples_a_word);
  const auto instances = static_cast<int>(word.views.size());
  const auto draw = [&](gl::Program& program, std::span<const std::byte> bytes,
                        std::span<const int> attributes) {
    int floats = 0;
    for (const int a : attributes) floats += a;
    const auto count = static_cast<int>(bytes.size() / (sizeof(float) * 3 * floats));
    if (count == 0) return;
    vertices_.write(bytes);
    program.set("size", static_cast<float>(pass.width), static_cast<float>(pass.height));
    program.draw_triangles(vertices_, attributes, count, instances, pass.width, pass.height,
                           gl::Combine::set_bits);
  };
  draw(triangles_, std::as_bytes(std::span(word.triangles)), std::array{3});
  set(spheres_, "origin", pass.origin);
  set(spheres_, "step_x", pass.step_x), set(spheres_, "step_y", pass.step_y);
  draw(spheres_, std::as_bytes(std::span(word.spheres)), std::array{3, 4});
}

std::vector<float> PassDrawer::draw(const SamplePass& pass) {
  grow(pass.width, pass.height);
  for (std::size_t i = 0; i < pass.words.size(); ++i) draw_word(pass, static_cast<int>(i));
  bits_->bind(hidden_unit);
  gl::Program& program = weights(pass.falloff);
  program.set("hidden", hidden_unit);
  set(program, "step_x", pass.step_x), set(program, "step_y", pass.step_y);
  sums_->use();
  for (std::size_t i = 0; i < pass.words.size(); ++i) {
    write_block(uniforms_, pass.words[i].weights, samples_a_word);
    program.set("layer", static_cast<int>(i));
    program.draw(pass.width, pass.height, i == 0 ? gl::Combine::replace : gl::Combine::add);
  }
  return sums_->read(0, pass.width, pass.height);
}

}  // namespace penumbra::bake
