#include "render/gl/picture.h"

#include <chrono>
#include <cmath>

#include "base/cancel.h"
#include "render/exposure.h"
#include "render/gl/band_sums.h"
#include "render/gl/bands.h"
#include "render/gl/point_patterns.h"
#include "render/hash.h"
#include "render/pixel_samples.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool wants_layers(const RenderOptions& o) {
  return o.want_visibility || o.want_depth || o.want_normal || o.want_steps ||
         o.shadows.kind == ShadowKind::area;
}

class PictureDrawer {
 public:
  PictureDrawer(const gl::Context& context, const Scene& scene, const FieldText& field,
                const RenderOptions& options)
      : context_(context),
        scene_(scene),
        field_(field),
        options_(options),
        lights_(shader_lights(scene)),
        textures_(field, lights_, context.longest_side()),
        ambient_(scene.ambient) {}

  RenderResult draw(Progress& progress);

 private:
  const Camera& view() const { return scene_.cameras[static_cast<std::size_t>(options_.camera)]; }
  int generations() const { return field_.mirrors ? options_.mirror_depth + 1 : 1; }
  /// `samples`: a pixel's.
  std::unique_ptr<gl::Program> program(const ShadowOptions& shadows, ShaderTask task, int width,
                                       int height, const Vec3& ambient, int samples) const;
  float exposure(const Vec3& ambient) const;
  void draw_band(gl::Program& program, const gl::Target& target, const Bands& bands,
                 BandSums& sums);
  void draw_sample(gl::Program& program, const gl::Target& target, const Bands& bands, int sample,
                   BandSums& sums);
  void set_streams(const Bands& bands, int sample);
  RenderResult empty_result() const;
  std::vector<PictureDraw> wanted_draws() const {
    return picture_draws(scene_, options_.shadows, points_at_a_time_, generations(),
                         lights_in_a_draw_);
  }

  const gl::Context& context_;
  const Scene& scene_;
  const FieldText& field_;
  const RenderOptions& options_;
  ShaderLights lights_;
  SceneTextures textures_;
  Vec3 ambient_;
  std::vector<PictureDraw> draws_;
  int points_at_a_time_ = 64;
  std::size_t lights_in_a_draw_ = lights_at_a_time;
  std::unique_ptr<PointPatterns> patterns_;
  std::vector<std::uint64_t> streams_;
};

std::unique_ptr<gl::Program> PictureDrawer::program(const ShadowOptions& shadows, ShaderTask task,
                                                    int width, int height, const Vec3& ambient,
                                                    int samples) const {
  auto made = field_program(field_, lights_, shadows, task, {width, height, options_.time});
  textures_.give(*made);
  const CameraRays camera(view(), width, height);
  set_camera(*made, camera);
  const CameraRay middle = camera.at(0, 0);
  const float share = 1 / std::sqrt(static_cast<float>(samples));
  made->set("pnb_beam", middle.width * share, middle.spread * share);
  made->set("pnb_ambient", ambient.x, ambient.y, ambient.z);
  const Vec3& sky = scene_.background;
  made->set("pnb_background", sky.x, sky.y, sky.z);
  made->set("pnb_mirrors", generations() - 1);
  return made;
}

float PictureDrawer::exposure(const Vec3& ambient) const {
  constexpr int width = exposure_grid_width, height = exposure_grid_height;
  ShadowOptions hard;
  hard.kind = ShadowKind::hard;
  auto coarse = program(hard, ShaderTask::picture_with_layers, width, height, ambient, 1);
  coarse->set("pnb_mirrors", 0);
  coarse->set("pnb_unlit_too", 1);
  coarse->set("pnb_in_pixel", 0.5f, 0.5f);
  const gl::Target target(width, height, 4);
  std::vector<Vec3> radiance(static_cast<std::size_t>(width) * height), unlit = radiance;
  std::vector<float> surfaces, notes;
  for (const PictureDraw& draw : picture_draws(scene_, hard, 1, 1)) {
    set_draw(*coarse, draw, lights_.list);
    target.use();
    coarse->draw(width, height);
    const std::vector<float> color = target.read(0, width, height);
    for (std::size_t i = 0; i < radiance.size(); ++i)
      radiance[i] += {color[4 * i], color[4 * i + 1], color[4 * i + 2]};
    if (draw.base) surfaces = target.read(1, width, height), notes = target.read(3, width, height);
  }
  SeenLuminances seen;
  for (std::size_t i = 0; i < radiance.size(); ++i) {
    const float* surface = &surfaces[4 * i];
    if (!(notes[4 * i + 1] > 0)) continue;
    if (surface[3] > 0) {
      seen.emission.push_back(surface[3]);
    } else if (notes[4 * i + 2] > 0) {
      seen.all.push_back(luminance(radiance[i]));
      if (radiance[i] != Vec3{surface[0], surface[1], surface[2]})
        seen.lit.push_back(luminance(radiance[i]));
    }
  }
  return exposure_from(seen, scene_.background);
}

void PictureDrawer::set_streams(const Bands& bands, int sample) {
  streams_.clear();
  for (int row = bands.from(); row < bands.from() + bands.rows(); ++row)
    for (int x = 0; x < options_.width; ++x) {
      const auto number = static_cast<std::uint64_t>(options_.height - 1 - row) *
                              static_cast<std::uint64_t>(options_.width) +
                          static_cast<std::uint64_t>(x);
      streams_.push_back(mix64(mix64(number, options_.seed), static_cast<std::uint64_t>(sample)));
    }
}

void PictureDrawer::draw_sample(gl::Program& program, const gl::Target& target, const Bands& bands,
                                int sample, BandSums& sums) {
  const Vec2 at = pixel_sample(sample, options_.spp);
  program.set("pnb_in_pixel", at.x, at.y);
  if (patterns_) set_streams(bands, sample);
  int generation = 0;
  for (const PictureDraw& draw : draws_) {
    throw_if_cancelled();
    set_draw(program, draw, lights_.list);
    if (draw.by_points()) {
      if (draw.generation < generation) set_streams(bands, sample), generation = 0;
      for (; generation < draw.generation; ++generation)
        for (std::uint64_t& stream : streams_) stream = mix64(stream);
      patterns_->set(program, draw.light_from, options_.width, streams_);
    }
    target.use();
    program.draw(options_.width, bands.rows());
    sums.add(draw, target);
  }
}

void PictureDrawer::draw_band(gl::Program& program, const gl::Target& target, const Bands& bands,
                              BandSums& sums) {
  program.set("pnb_tile", 0.0f, static_cast<float>(bands.from()));
  for (;;) {
    sums.begin(bands.from(), bands.rows());
    for (int sample = 0; sample < options_.spp; ++sample)
      draw_sample(program, target, bands, sample, sums);
    if (sums.cut() == 0) break;
    // Perhaps only too many of our own points or lights at a time.
    const bool can_take_less = patterns_ ? points_at_a_time_ > 1 : lights_in_a_draw_ > 1;
    if (!can_take_less) refuse_cut_loops(field_, context_.renderer(), sums.cut(), sums.samples());
    if (patterns_)
      points_at_a_time_ = std::max(1, points_at_a_time_ / 8);
    else
      lights_in_a_draw_ = 1;
    draws_ = wanted_draws();
  }
  sums.finish();
}

RenderResult PictureDrawer::empty_result() const {
  const RenderOptions& o = options_;
  RenderResult result;
  result.color = Image(o.width, o.height, 3);
  if (o.want_visibility) result.visibility.assign(lights_.list.size(), Image(o.width, o.height, 1));
  if (o.want_depth) result.depth = Image(o.width, o.height, 1);
  if (o.want_normal) result.normal = Image(o.width, o.height, 3);
  if (o.want_steps) result.steps = Image(o.width, o.height, 1);
  if (o.want_error) result.error = Image(o.width, o.height, 1);
  return result;
}

RenderResult PictureDrawer::draw(Progress& progress) {
  progress.start("compile", 0);
  const auto build_start = Clock::now();
  RenderResult result = empty_result();
  const bool automatic = scene_.ambient_is_automatic;
  if (automatic) ambient_ = Vec3();
  if (automatic || !options_.exposure_ev) result.stats.exposure_ev = exposure(ambient_);
  if (automatic) ambient_ = automatic_ambient(result.stats.exposure_ev);
  result.stats.exposure_ev = options_.exposure_ev.value_or(result.stats.exposure_ev);
  const bool layers = wants_layers(options_);
  auto shader =
      program(options_.shadows, layers ? ShaderTask::picture_with_layers : ShaderTask::picture,
              options_.width, options_.height, ambient_, options_.spp);
  shader->set("pnb_ask_all", options_.want_visibility || options_.want_steps ? 1 : 0);
  draws_ = wanted_draws();
  Bands bands(options_.width, options_.height, context_.longest_side());
  const gl::Target target(options_.width, bands.most_rows(), layers ? 4 : 1);
  if (options_.shadows.kind == ShadowKind::area)
    patterns_ = std::make_unique<PointPatterns>(light_point_count(options_.shadows), options_.seed,
                                                options_.width, bands.most_rows());
  progress.finish();
  result.stats.seconds_build = seconds_since(build_start);
  result.stats.device = context_.renderer();
  result.stats.ambient = ambient_;
  const auto start = Clock::now();
  progress.start("render", static_cast<std::uint64_t>(options_.height));
  BandSums sums(options_, result);
  while (!bands.done()) {
    const auto band_start = Clock::now();
    const int rows = bands.rows();
    draw_band(*shader, target, bands, sums);
    bands.next(seconds_since(band_start), options_.spp * static_cast<int>(draws_.size()));
    progress.advance(static_cast<std::uint64_t>(rows));
  }
  progress.finish();
  if (sums.eye_is_inside()) result.warnings.emplace_back(warning_of_blind_eye);
  result.stats.seconds_render = seconds_since(start);
  return result;
}

}  // namespace

RenderResult draw_picture(const gl::Context& context, const Scene& scene, const FieldText& field,
                          const RenderOptions& options, Progress& progress) {
  return PictureDrawer(context, scene, field, options).draw(progress);
}

}  // namespace penumbra
