#include "gl/thread.h"

#include <array>
#include <stdexcept>
#include <string>

#include "gl/bit_layers.h"
#include "gl/driver.h"
#include "gl/program.h"
#include "gl/target.h"

namespace penumbra::gl {
namespace {

/// Floats made in a process of their own, which may have a Thread.
std::vector<float> made(const std::function<std::vector<float>()>& make) {
  Progress silent;
  const std::string bytes = guarded(
      [&](Progress&) {
        const std::vector<float> floats = make();
        return std::string(reinterpret_cast<const char*>(floats.data()),
                           floats.size() * sizeof(float));
      },
      silent);
  std::vector<float> floats(bytes.size() / sizeof(float));
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  return floats;
}

bool has_core_driver() {
  try {
    made([] {
      const Thread thread(Profile::core);
      return std::vector<float>();
    });
    return true;
  } catch (const WorkError&) {
    return false;
  }
}

class ThreadTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_core_driver()) GTEST_SKIP() << "no OpenGL 4.5 driver that draws without a display";
  }
};

TEST_F(ThreadTest, DoesTheWorkOfManyAndThrowsWhatItThrows) {
  const std::vector<float> sums = made([] {
    Thread thread(Profile::core);
    int sum = 0, caught = 0;
    std::mutex counting;
    std::vector<std::thread> others;
    for (int k = 0; k < 4; ++k)
      others.emplace_back([&] {
        for (int i = 0; i < 100; ++i) try {
            thread.run([&] {
              ++sum;
              if (i % 10 == 0) throw std::runtime_error("ten");
            });
          } catch (const std::runtime_error&) {
            const std::lock_guard lock(counting);
            ++caught;
          }
      });
    for (std::thread& other : others) other.join();
    return std::vector<float>{static_cast<float>(sum), static_cast<float>(caught)};
  });
  EXPECT_EQ(sums, (std::vector<float>{400, 40}));
}

const std::string kCorners =
    "#version 450\nlayout(location = 0) in vec2 at;\nlayout(location = 1) in float side;\n"
    "flat out uint bit;\nvoid main() { bit = 1u << (4 * gl_InstanceID + int(side));\n"
    "gl_Position = vec4(at, 0, 1); }\n";
const std::string kBits =
    "#version 450\nflat in uint bit;\nlayout(location = 0) out uint bits;\n"
    "void main() { bits = bit; }\n";
const std::string kShow =
    "#version 450\nuniform usampler2DArray words;\nuniform int layer;\n"
    "layout(location = 0) out vec4 a;\nvoid main() {\n"
    "a = vec4(texelFetch(words, ivec3(gl_FragCoord.xy, layer), 0).x, 0, 0, 0); }\n";

TEST_F(ThreadTest, TrianglesSetBitsOfLayers) {
  const std::vector<float> words = made([] {
    const Context context(Profile::core);
    Program corners(kCorners, kBits), show(kShow);
    const BitLayers layers(4, 4, 2);
    Buffer vertices;
    // The lower left half of 2 x 2 texels, and all of them.
    const std::vector<float> triangles{-1, -1, 0, 1.5f, -1, 0, -1, 1.5f, 0,
                                       -1, -1, 1, 3,    -1, 1, -1, 3,    1};
    vertices.write(std::as_bytes(std::span(triangles)));
    layers.clear(0, 64, 2, 2);
    layers.use(0);
    corners.draw_triangles(vertices, std::array{2, 1}, 2, 2, 2, 2, Combine::set_bits);
    layers.write(1, 2, 2, std::vector<std::uint32_t>{0, 5, 7, 256});
    layers.use(1);
    corners.draw_triangles(vertices, std::array{2, 1}, 1, 1, 2, 2, Combine::set_bits);
    layers.bind(1);
    show.set("words", 1);
    std::vector<float> found;
    const Target target(2, 2, 1);
    for (int layer = 0; layer < 2; ++layer) {
      show.set("layer", layer);
      target.use();
      show.draw(2, 2);
      const std::vector<float> texels = target.read(0, 2, 2);
      for (std::size_t i = 0; i < texels.size(); i += 4) found.push_back(texels[i]);
    }
    return found;
  });
  EXPECT_EQ(words, (std::vector<float>{64 + 51, 64 + 51, 64 + 51, 64 + 34, 1, 5, 7, 256}));
}

}  // namespace
}  // namespace penumbra::gl
