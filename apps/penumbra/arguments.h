// What a person asked for on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/bake_options.h"
#include "bake/plan.h"
#include "bake/store.h"
#include "diff_options.h"
#include "light_factor.h"
#include "render/gl/render_gl.h"
#include "render/render.h"
#include "report/sweep.h"
#include "scene/scene.h"
#include "sdf/convert.h"

namespace penumbra::app {

enum class Command { render, probe, info, make_new, export_shader, bake, compare, diff, animate };

enum class Device { automatic, cpu, gl };

/// One `--aov NAME=FILE.exr`; steps may be a heat map, FILE.png.
struct AovRequest {
  std::string name;  ///< visibility, depth, normal, error or steps
  std::string file;
};

/// What bake alone is asked.
struct BakeArguments {
  bake::BakeOptions light;
  bake::TextureOptions textures;
  float error = 0;                  ///< PassOptions::error
  std::optional<float> time_limit;  ///< seconds of light
  bool lightmap = false, hdr = false;
  bake::Store store = bake::Store::radiance;
  std::string preview;  ///< HTML file; empty = none
};

/// What animate alone is asked.
struct AnimationArguments {
  int frames = 0;  ///< 0 = as many as what moves takes
  double frames_per_second = 24;
  double turntable = 0;  ///< degrees that the camera goes round
  bool resume = false;   ///< frames that are there are kept
};

/// What compare alone is asked.
struct CompareArguments {
  std::vector<ShadowKind> methods;  ///< each once; empty = all but none
  std::optional<int> repeats;
  std::vector<report::SweepRequest> sweeps;
};

struct Arguments {
  Command command = Command::render;
  std::string scene;         ///< the scene file; of `new`, the file to write
  std::string output;        ///< -o; empty = standard output (probe)
  std::string points;        ///< probe: the CSV of points
  std::string camera = "0";  ///< name or index
  RenderOptions render;      ///< its camera is set once the scene is known
  Device device = Device::automatic;
  Entry entry = Entry::automatic;  ///< of a shader
  std::vector<Light> lights;       ///< --light
  bool keep_scene_lights = true;
  float light_size = 1;
  std::vector<LightFactor> light_factors;  ///< --light-factor
  std::vector<AovRequest> aovs;
  std::string stats;  ///< file of --stats; empty = none
  int threads = 0;    ///< 0 = all cores
  bool quiet = false;
  sdf::ConversionOptions conversion;
  BakeArguments bake;
  CompareArguments compare;
  bool choose_method = false;  ///< --shadows auto
  DiffArguments diff;
  AnimationArguments animation;
  bool schema = false;                    ///< new: the schema instead of a scene
  std::vector<std::string> given;         ///< names of the options that were given
  std::vector<std::string> command_line;  ///< as it was typed
};

}  // namespace penumbra::app
