// One picture of a scene, by whichever renderer the arguments ask for.
#pragma once

#include "arguments.h"
#include "console.h"

namespace penumbra::app {

struct Picture {
  RenderResult result;
  double seconds_build = 0;         ///< of what the renderer looks things up in
  std::size_t structure_bytes = 0;  ///< of the same
};

/// Builds what the method needs and draws. May change the arguments to what a shader takes.
Picture make_picture(Arguments& arguments, const Scene& scene, Console& console);

}  // namespace penumbra::app
