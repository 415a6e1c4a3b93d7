#include <chrono>

#include "base/cancel.h"
#include "gl/target.h"
#include "image/srgb.h"
#include "render/gl/bands.h"
#include "render/gl/field_program.h"
#include "render/gl/picture.h"
#include "render/pixel_samples.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class OwnPicture {
 public:
  OwnPicture(const gl::Context& context, const FieldText& field, const RenderOptions& options,
             RenderResult& result)
      : context_(context), field_(field), options_(options), result_(result) {}

  void draw_band(gl::Program& program, const gl::Target& target, const Bands& bands);

 private:
  void add(const gl::Target& target, const Bands& bands, std::uint64_t& cut);

  const gl::Context& context_;
  const FieldText& field_;
  const RenderOptions& options_;
  RenderResult& result_;
};

void OwnPicture::add(const gl::Target& target, const Bands& bands, std::uint64_t& cut) {
  const float share = 1 / static_cast<float>(options_.spp);
  const std::vector<float> texels = target.read(0, options_.width, bands.rows());
  for (int row = 0; row < bands.rows(); ++row)
    for (int x = 0; x < options_.width; ++x) {
      const float* from = &texels[4 * (static_cast<std::size_t>(row) * options_.width + x)];
      float* to = result_.color.at(x, options_.height - 1 - bands.from() - row);
      cut += PixelNotes(from[3]).cut;
      for (int c = 0; c < 3; ++c)
        to[c] += share * (from[c] > 0 ? std::min(from[c], 1.0f) : 0);  // NaN is black
    }
}

void OwnPicture::draw_band(gl::Program& program, const gl::Target& target, const Bands& bands) {
  std::uint64_t cut = 0;
  program.set("pnb_tile", 0.0f, static_cast<float>(bands.from()));
  for (int sample = 0; sample < options_.spp; ++sample) {
    throw_if_cancelled();
    const Vec2 at = pixel_sample(sample, options_.spp);
    program.set("pnb_in_pixel", at.x, 1 - at.y);
    target.use();
    program.draw(options_.width, bands.rows());
    add(target, bands, cut);
  }
  if (cut > 0)
    refuse_cut_loops(field_, context_.renderer(), cut,
                     static_cast<std::uint64_t>(options_.width) *
                         static_cast<std::uint64_t>(bands.rows() * options_.spp));
}

}  // namespace

RenderResult draw_own_picture(const gl::Context& context, const FieldText& field,
                              const RenderOptions& options, Progress& progress) {
  progress.start("compile", 0);
  const auto build_start = Clock::now();
  RenderResult result;
  result.color = Image(options.width, options.height, 3);
  result.stats.device = context.renderer();
  const auto program = field_program(field, {}, options.shadows, ShaderTask::own_picture,
                                     {options.width, options.height, options.time});
  Bands bands(options.width, options.height, context.longest_side());
  const gl::Target target(options.width, bands.most_rows(), 1);
  progress.finish();
  result.stats.seconds_build = seconds_since(build_start);
  const auto start = Clock::now();
  progress.start("render", static_cast<std::uint64_t>(options.height));
  OwnPicture picture(context, field, options, result);
  while (!bands.done()) {
    const auto band_start = Clock::now();
    const int rows = bands.rows();
    picture.draw_band(*program, target, bands);
    bands.next(seconds_since(band_start), options.spp);
    progress.advance(static_cast<std::uint64_t>(rows));
  }
  progress.finish();
  for (float& value : result.color.data)
    value = static_cast<float>(linear_from_srgb(static_cast<double>(value)));
  for (const std::string& channel : field.user->channels)
    result.warnings.push_back(channel + " is black: textures are not loaded");
  result.stats.seconds_render = seconds_since(start);
  return result;
}

}  // namespace penumbra
