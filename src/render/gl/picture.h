// Pictures drawn by OpenGL in this process. Callers other than tests want render_gl.h, whose child
// process can be stopped.
#pragma once

#include "base/progress.h"
#include "gl/context.h"
#include "render/glsl/field_text.h"
#include "render/render.h"

namespace penumbra {

/// The picture of a field as render() gives it. Throws InputError for what shaders cannot show,
/// WorkError if the driver gives up.
RenderResult draw_picture(const gl::Context& context, const Scene& scene, const FieldText& field,
                          const RenderOptions& options, Progress& progress);

/// The picture of a shader's mainImage: iResolution is the picture's size, iTime the options',
/// iFrame, iMouse and iDate 0, channels black. Its color is what Shadertoy shows: sRGB, clamped.
/// With spp > 1 pixels are averaged over positions inside them.
RenderResult draw_own_picture(const gl::Context& context, const FieldText& field,
                              const RenderOptions& options, Progress& progress);

}  // namespace penumbra
