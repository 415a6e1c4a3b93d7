// Which of the renderers does the work.
#pragma once

#include "arguments.h"
#include "console.h"

namespace penumbra::app {

/// True if OpenGL is to draw the scene: asked for, or a shader that nothing else can show. Throws
/// InputError if the chosen device cannot show it, or if a shader meets options that it cannot
/// take.
bool draws_with_gl(const Arguments& arguments, const Scene& scene);

/// True if the scene is a shader whose own mainImage makes the picture.
bool is_own_picture(const Arguments& arguments, const Scene& scene);

/// Puts the options in place that a shader's picture takes by default: its own method (sdf-improved
/// for its map), one sample of each pixel for mainImage. Says what has no effect.
void adapt_to_gl(Arguments& arguments, const Scene& scene, Console& console);

}  // namespace penumbra::app
