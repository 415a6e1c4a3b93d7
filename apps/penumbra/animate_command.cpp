#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "base/atomic_file.h"
#include "base/error.h"
#include "commands.h"
#include "device.h"
#include "film.h"
#include "frame_names.h"
#include "memory.h"
#include "outputs.h"
#include "picture.h"
#include "prepare.h"
#include "scene/extent.h"
#include "scene/turntable.h"
#include "stats.h"
#include "stored_picture.h"

namespace penumbra::app {
namespace {

constexpr double seconds_without_end = 4;  // of turntables and shaders
constexpr int most_frames = 1'000'000;

class Animation {
 public:
  Animation(Arguments& arguments, Console& console)
      : arguments_(arguments), console_(console), quiet_(true), start_(arguments.render.time) {}

  void run() {
    find_names();
    Arguments first = at(0);
    warn_of_idle_options(first, console_);
    const Scene scene = prepare_scene(first, console_);
    frames_ = frame_count(scene);
    chosen_camera(scene, arguments_.camera);
    check_picture_fits(first, scene.lights.size());
    check_keyframes(scene);
    std::filesystem::create_directories(std::filesystem::path(names_->of(0)).parent_path());
    for (const int frame : {0, frames_ - 1}) check_outputs(at(frame));
    console_.remark(fmt::format("{} frames, {:g} a second", frames_, speed()));
    console_.start("frames", static_cast<std::uint64_t>(frames_));
    for (int frame = 0; frame < frames_; ++frame) draw(frame);
    console_.finish();
    if (is_film(arguments_.output)) join();
    if (!arguments_.stats.empty()) write_counts(scene);
  }

 private:
  double speed() const { return arguments_.animation.frames_per_second; }

  /// What draws one frame.
  Arguments at(int frame) const {
    Arguments a = arguments_;
    a.render.time = static_cast<float>(start_ + frame / speed());
    a.output = names_->of(frame);
    a.stats.clear();
    return a;
  }

  void find_names() {
    const std::string& output = arguments_.output;
    if (is_film(output)) {
      check_ffmpeg();
      const AtomicFile can_be_written(output);
      std::string escaped;
      for (const char c : output) escaped += c == '%' ? "%%" : std::string(1, c);
      pattern_ = escaped + ".frames/%06d.png";
    } else {
      pattern_ = output;
    }
    names_ = FrameNames::from(pattern_);
    if (!names_)
      throw InputError({output}, "this names one file, and a film has many frames",
                       "write -o frames/%04d.png, or a film: -o film.mp4");
  }

  int frame_count(const Scene& scene) const {
    const AnimationArguments& wanted = arguments_.animation;
    const bool goes_on = wanted.turntable != 0 || scene.glsl;
    const auto& times = scene.keyframe_times;
    if (!goes_on && times.empty())
      throw InputError({arguments_.scene}, "nothing moves in this scene",
                       "give its things \"keyframes\", or add --turntable 360");
    if (wanted.frames > 0) return wanted.frames;
    const double end = times.empty() ? start_ : times.back();
    const double frames = end > start_ ? std::floor((end - start_) * speed() + 1e-6) + 1
                          : goes_on    ? std::max(1.0, std::round(seconds_without_end * speed()))
                                       : 1;
    if (frames > most_frames)
      throw InputError(fmt::format("the film would have {:.0f} frames", frames),
                       "give --frames, or a smaller --fps");
    return static_cast<int>(frames);
  }

  // A keyframe that cannot be is better found before the first frame than after the hundredth.
  void check_keyframes(const Scene& scene) const {
    if (!has_extension(arguments_.scene, ".json")) return;
    Arguments a = at(0);
    Console quiet(true);
    for (const double time : scene.keyframe_times) {
      a.render.time = static_cast<float>(time);
      prepare_scene(a, quiet);
    }
  }

  void draw(int frame) {
    Arguments a = at(frame);
    const bool is_drawn = arguments_.animation.resume && std::filesystem::exists(a.output);
    const bool needs_exposure = !exposure_ && has_extension(a.output, ".png");
    a.render.exposure_ev = exposure_;
    if (!is_drawn || needs_exposure) {
      Scene scene = prepare_scene(a, quiet_);
      prefer_stored(a, scene, quiet_);
      a.render.camera = chosen_camera(scene, arguments_.camera);
      turn(scene, a.render.camera, frame);
      const Picture picture = make_picture(a, scene, quiet_);
      note(picture.result);
      if (!is_drawn) write_outputs(a, scene, picture.result), ++drawn_;
    }
    console_.advance(1);
  }

  void turn(Scene& scene, int camera, int frame) const {
    const double degrees = arguments_.animation.turntable;
    if (degrees == 0) return;
    Camera& c = scene.cameras[static_cast<std::size_t>(camera)];
    c = turned_about_scene(c, extent_of(scene), degrees * std::numbers::pi / 180 * frame / frames_);
  }

  // All frames are exposed as the first.
  void note(const RenderResult& result) {
    if (!exposure_) exposure_ = result.stats.exposure_ev;
    if (warned_) return;
    for (const std::string& text : result.warnings) console_.warn(text);
    warned_ = !result.warnings.empty();
  }

  void join() const {
    console_.start("film", 0);
    const std::filesystem::path folder = std::filesystem::path(names_->of(0)).parent_path();
    make_film(pattern_, frames_, speed(), folder.string(), arguments_.output);
    std::error_code ignored;
    for (int frame = 0; frame < frames_; ++frame)
      std::filesystem::remove(names_->of(frame), ignored);
    std::filesystem::remove(folder, ignored);
    console_.finish();
  }

  void write_counts(const Scene& scene) const {
    Json::Value json = common_stats(arguments_, scene, 0);
    json["frames"]["all"] = frames_;
    json["frames"]["drawn"] = drawn_;
    json["frames"]["per_second"] = speed();
    json["exposure_ev"] = exposure_.value_or(0);
    json["seconds"]["all"] = clock_.seconds();
    write_stats(arguments_.stats, json);
  }

  const Arguments& arguments_;
  Console& console_;
  Console quiet_;
  const Stopwatch clock_;
  double start_;
  std::string pattern_;
  std::optional<FrameNames> names_;
  std::optional<float> exposure_ = arguments_.render.exposure_ev;
  int frames_ = 0, drawn_ = 0;
  bool warned_ = false;
};

}  // namespace

void run_animate(Arguments& arguments, Console& console) {
  if (!arguments.aovs.empty())
    throw InputError("--aov: a film has pictures alone",
                     "take AOVs of one moment: render --time T");
  Animation(arguments, console).run();
}

}  // namespace penumbra::app
