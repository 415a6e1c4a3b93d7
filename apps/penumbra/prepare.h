// From Arguments to a scene and a world, with everything said that needs saying.
#pragma once

#include <memory>

#include "arguments.h"
#include "console.h"
#include "geometry/world.h"

namespace penumbra::app {

/// Warns of options that have no effect on the chosen command and method; throws InputError for a
/// variant of another method.
void warn_of_idle_options(const Arguments& arguments, Console& console);

/// Loads the scene and applies the light options; repeats the load report on the console.
Scene prepare_scene(const Arguments& arguments, Console& console);

/// The index of the camera that the arguments name; throws InputError.
int chosen_camera(const Scene& scene, const std::string& name_or_index);

/// Builds what the chosen method needs of a world; keeps a reference to the scene.
std::unique_ptr<World> build_world(const Scene& scene, const Arguments& arguments,
                                   Console& console);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace penumbra::app
