// The renderer of distance fields on OpenGL.
#pragma once

#include "gl/guarded.h"
#include "render/gl/probe.h"

namespace penumbra {

/// What a shader with map and mainImage is asked for.
enum class Entry : std::uint8_t { automatic, map, main_image };

/// As render(), of a scene's distance field or its shader's own picture (of a shader with
/// mainImage, unless `entry` asks for map). Drawn in a child process (gl/guarded.h): no call of
/// parallel_for in the same thread may be under way. Throws InputError for what shaders cannot show
/// or what they have wrong, WorkError if there is no driver or it gives up.
RenderResult render_gl(const Scene& scene, const RenderOptions& options, Entry entry,
                       Progress& progress, const gl::Patience& patience = {});

/// Visible fractions in the scene's field, of its map; the rest as render_gl.
ProbeAnswers probe_gl(const Scene& scene, const RenderOptions& options,
                      std::span<const ProbeQuery> queries, Progress& progress,
                      const gl::Patience& patience = {});

/// A complete Shadertoy shader of the scene (glsl/export.h). Exposure and ambient light are found
/// by drawing where the options or the file do not say them.
std::string export_shadertoy(const Scene& scene, const RenderOptions& options,
                             const std::string& source, Progress& progress,
                             std::vector<std::string>& warnings);

}  // namespace penumbra
