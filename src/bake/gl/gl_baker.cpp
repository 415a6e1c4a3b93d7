#include "bake/gl/gl_baker.h"

#include <algorithm>
#include <optional>
#include <string>

#include "bake/gl/pass_drawer.h"
#include "bake/tiles.h"
#include "base/cancel.h"
#include "base/error.h"
#include "gl/thread.h"

namespace penumbra::bake {
namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

/// The thread that draws, and what it draws with.
class GlBaker::Drawing {
 public:
  Drawing() : thread_(gl::Profile::core) {
    try {
      thread_.run([this] { drawer_.emplace(); });
    } catch (const gl::CompileError& error) {
      throw WorkError("the OpenGL driver refuses a shader: " + first_line(error.what()),
                      "use another driver, or --device cpu");
    }
  }
  ~Drawing() {
    thread_.run([this] { drawer_.reset(); });
  }
  const std::string& renderer() const { return thread_.renderer(); }
  std::vector<float> draw(const SamplePass& pass) {
    std::vector<float> sums;
    thread_.run([&] { sums = drawer_->draw(pass); });
    return sums;
  }

 private:
  std::optional<PassDrawer> drawer_;
  gl::Thread thread_;
};

GlBaker::GlBaker(const Occluders& occluders)
    : occluders_(occluders), drawing_(std::make_unique<Drawing>()) {}

GlBaker::~GlBaker() = default;

std::unique_ptr<GlBaker> GlBaker::on_graphics_processor(const Occluders& occluders) {
  if (!gl::may_have_graphics_processor()) return nullptr;
  try {
    auto baker = std::make_unique<GlBaker>(occluders);
    if (gl::is_graphics_processor(baker->drawing_->renderer())) return baker;
  } catch (const WorkError&) {
    // No driver for it: the other ways do the work.
  }
  return nullptr;
}

TexelSums GlBaker::bake(const Tile& tile, const OwnTriangles& own, const SampledLight& light,
                        BakeQuantity quantity) const {
  TexelSums lit, whole;
  lit.resize(tile.width, tile.height), whole.resize(tile.width, tile.height);
  const std::span<const LightSample> samples(light.samples);
  for (std::size_t first = 0; first < samples.size(); first += samples_a_pass) {
    throw_if_cancelled();
    const auto some = samples.subspan(first, std::min(samples_a_pass, samples.size() - first));
    const std::vector<float> sums =
        drawing_->draw(prepare_pass(occluders_, tile, own, light, some, quantity));
    const float* at = sums.data();
    for (int j = 0; j < tile.height; ++j)
      for (int i = 0; i < tile.width; ++i, at += 4)
        lit.row(j)[i] += at[0], whole.row(j)[i] += at[1];
  }
  if (!samples.empty()) finish(tile, light, quantity, whole, lit);
  return lit;
}

void GlBaker::irradiance(const PlanarChart& chart, std::span<const SampledLight> lights,
                         std::span<Vec3> out) const {
  const OwnTriangles own(chart);
  const auto stride = static_cast<std::size_t>(chart.width);
  std::fill(out.begin(), out.end(), Vec3());
  for_tiles(chart, most_tile_side, most_tile_side, [&](const Tile& tile) {
    for (const SampledLight& light : lights)
      if (!light.samples.empty())
        emit(bake(tile, own, light, BakeQuantity::irradiance), light.emission, true,
             &out[first_texel(chart, tile)], stride);
  });
}

void GlBaker::fractions(const PlanarChart& chart, const SampledLight& light, BakeQuantity quantity,
                        std::span<float> out) const {
  const OwnTriangles own(chart);
  for_tiles(chart, most_tile_side, most_tile_side, [&](const Tile& tile) {
    const TexelSums sums = bake(tile, own, light, quantity);
    float* to = &out[first_texel(chart, tile)];
    for (int j = 0; j < tile.height; ++j, to += chart.width)
      for (int i = 0; i < tile.width; ++i) to[i] = std::min(sums.row(j)[i], 1.0f);
  });
}

}  // namespace penumbra::bake
