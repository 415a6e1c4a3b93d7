// Pictures of distance fields by our processor and by OpenGL, whole, in one run.
//   bench_fields [--shapes N] [--against N] [--smooth] [--size WxH] [--repeats N] [--threads N]
//                [--method NAME] [--gl]
// Prints lines NAME<tab>VALUE: seconds of a picture by device and method (cpu/hard …), ratios of
// turns taken together (cpu/classic_over_hard, gl_over_cpu/classic), and by method the share of
// pixels of which a colour's 8-bit code differs by more than one between the devices (differing/…).
// hard is the plain published march. --against: the time of as many shapes over that of N others
// (more_over_fewer/…). --method: that alone, without its ratio over hard. --gl: our GLSL of the
// scene as well, one draw and one finish a picture.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "field_scene.h"
#include "gl/context.h"
#include "gl/target.h"
#include "image/srgb.h"
#include "race.h"
#include "render/gl/draws.h"
#include "render/gl/field_program.h"
#include "render/glsl/field_text.h"
#include "render/render.h"

namespace penumbra::bench {
namespace {

struct Method {
  const char* name;
  ShadowKind kind;
  SdfVariant variant;
};
constexpr Method all_methods[] = {{"hard", ShadowKind::hard, SdfVariant::march},
                                  {"classic", ShadowKind::sdf_classic, SdfVariant::published},
                                  {"improved", ShadowKind::sdf_improved, SdfVariant::published},
                                  {"inner", ShadowKind::sdf_inner, SdfVariant::published}};

struct Arguments {
  int shapes = 8, against = 0, width = 1280, height = 720, repeats = 5, threads = 0;
  bool smooth = false, gl = false;
  std::vector<Method> methods{std::begin(all_methods), std::end(all_methods)};
};

struct Silence final : Progress {
  void start(std::string_view, std::uint64_t) override {}
  void advance(std::uint64_t) override {}
};

RenderOptions options_of(const Arguments& a, const Method& method) {
  RenderOptions o;
  o.width = a.width, o.height = a.height, o.spp = 1;
  o.exposure_ev = 0.0f;
  o.shadows.kind = method.kind, o.shadows.variant = method.variant;
  return o;
}

/// A scene, ready for the processor.
struct Stage {
  Stage(const Arguments& a, int shapes) : arguments(a), scene(field_scene(shapes, a.smooth)) {
    WorldOptions options;
    options.cone_tree = false, options.field = true;
    world = std::make_unique<World>(scene, options);
  }
  Image picture(const Method& method) const {
    Silence silence;
    return render(*world, options_of(arguments, method), silence).color;
  }

  const Arguments& arguments;
  Scene scene;
  std::unique_ptr<World> world;
};

/// The same by OpenGL: a program for each method, made beforehand.
class Shaders {
 public:
  Shaders(const Arguments& a, const Scene& scene)
      : width_(a.width), height_(a.height), target_(width_, height_, 1) {
    const FieldText field = field_text(scene, true);
    const ShaderLights lights = shader_lights(scene);
    for (const Method& method : a.methods) {
      const RenderOptions o = options_of(a, method);
      auto program =
          field_program(field, lights, o.shadows, ShaderTask::picture, {width_, height_, 0});
      set_camera(*program, CameraRays(scene.cameras[0], width_, height_));
      const Vec3 &sky = scene.background, &ambient = scene.ambient;
      program->set("pnb_ambient", ambient.x, ambient.y, ambient.z);
      program->set("pnb_background", sky.x, sky.y, sky.z);
      program->set("pnb_mirrors", 0);
      program->set("pnb_in_pixel", 0.5f, 0.5f);
      program->set("pnb_tile", 0.0f, 0.0f);
      set_draw(*program, picture_draws(scene, o.shadows, 1, 1).front(), lights.list);
      programs_.push_back(std::move(program));
    }
  }
  void draw(std::size_t method) {
    target_.use();
    programs_[method]->draw(width_, height_);
  }
  Image picture(std::size_t method) {
    draw(method);
    const std::vector<float> texels = target_.read(0, width_, height_);
    Image image(width_, height_, 3);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        std::copy_n(&texels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                 static_cast<std::size_t>(x))],
                    3, image.at(x, height_ - 1 - y));
    return image;
  }

 private:
  int width_, height_;
  gl::Target target_;
  std::vector<std::unique_ptr<gl::Program>> programs_;
};

double differing(const Image& a, const Image& b) {
  const SrgbEncoder code;
  int count = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const float *p = a.at(x, y), *q = b.at(x, y);
      bool differs = false;
      for (int c = 0; c < 3; ++c) differs = differs || std::abs(code(p[c]) - code(q[c])) > 1;
      count += differs;
    }
  return static_cast<double>(count) / (double(a.width) * a.height);
}

void say(const std::string& name, double value) { fmt::print("{}\t{:.6g}\n", name, value); }

void measure(const Arguments& a) {
  const Stage stage(a, a.shapes);
  say("megabytes", static_cast<double>(stage.world->memory_bytes()) / 1e6);
  if (a.repeats == 0) return;
  std::unique_ptr<Stage> fewer;
  if (a.against > 0) fewer = std::make_unique<Stage>(a, a.against);
  std::unique_ptr<gl::Context> context;
  std::unique_ptr<Shaders> shaders;
  if (a.gl) {
    context = std::make_unique<gl::Context>();
    shaders = std::make_unique<Shaders>(a, stage.scene);
    fmt::print("renderer\t{}\n", context->renderer());
  }
  Race race;
  const std::size_t count = a.methods.size();
  std::vector<std::size_t> cpu(count), gl(count), few(count);
  for (std::size_t m = 0; m < count; ++m) {
    const Method& method = a.methods[m];
    cpu[m] = race.add(fmt::format("cpu/{}", method.name), [&] { stage.picture(method); });
    if (shaders) gl[m] = race.add(fmt::format("gl/{}", method.name), [&, m] { shaders->draw(m); });
    if (fewer)
      few[m] = race.add(fmt::format("fewer/{}", method.name), [&] { fewer->picture(method); });
  }
  race.run(a.repeats);
  for (std::size_t m = 0; m < count; ++m) {
    const char* name = a.methods[m].name;
    say(race.name(cpu[m]), race.time(cpu[m]));
    if (m > 0) say(fmt::format("cpu/{}_over_hard", name), race.ratio(cpu[m], cpu[0]));
    if (fewer) say(fmt::format("more_over_fewer/{}", name), race.ratio(cpu[m], few[m]));
    if (!shaders) continue;
    say(race.name(gl[m]), race.time(gl[m]));
    if (m > 0) say(fmt::format("gl/{}_over_hard", name), race.ratio(gl[m], gl[0]));
    say(fmt::format("gl_over_cpu/{}", name), race.ratio(gl[m], cpu[m]));
    say(fmt::format("differing/{}", name),
        differing(stage.picture(a.methods[m]), shaders->picture(m)));
  }
}

int number(const char* option, const char* text, int least) {
  char* end = nullptr;
  const long n = text ? std::strtol(text, &end, 10) : -1;
  if (!text || *end || n < least || n > 1'000'000)
    throw InputError(fmt::format("{}: a whole number from {} on is needed", option, least),
                     "see the top of bench/bench_fields.cpp");
  return static_cast<int>(n);
}

Method method_of(const std::string& name) {
  for (const Method& method : all_methods)
    if (name == method.name) return method;
  throw InputError("--method: there is no " + name, "use hard, classic, improved or inner");
}

Arguments parse(char** argv) {
  Arguments a;
  for (++argv; *argv; ++argv) {
    const std::string option = *argv;
    if (option == "--smooth" || option == "--gl") {
      (option == "--gl" ? a.gl : a.smooth) = true;
      continue;
    }
    const char* value = argv[1];
    if (option == "--size" && value && std::sscanf(value, "%dx%d", &a.width, &a.height) == 2 &&
        a.width > 0 && a.height > 0)
      ++argv;
    else if (option == "--shapes")
      a.shapes = number("--shapes", value, 1), ++argv;
    else if (option == "--against")
      a.against = number("--against", value, 1), ++argv;
    else if (option == "--method" && value)
      a.methods = {method_of(value)}, ++argv;
    else if (option == "--repeats")
      a.repeats = number("--repeats", value, 0), ++argv;
    else if (option == "--threads")
      a.threads = number("--threads", value, 0), ++argv;
    else
      throw InputError("unknown or wrong: " + option, "see the top of bench/bench_fields.cpp");
  }
  return a;
}

}  // namespace
}  // namespace penumbra::bench

int main(int, char** argv) {
  try {
    const auto arguments = penumbra::bench::parse(argv);
    const penumbra::ThreadLimit limit(arguments.threads);
    penumbra::bench::measure(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench_fields: {}\n", error.what());
    return 1;
  }
}
