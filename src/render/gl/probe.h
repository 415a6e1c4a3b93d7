// Visible fractions by OpenGL in this process; see picture.h.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "gl/context.h"
#include "render/glsl/field_text.h"
#include "render/render.h"

namespace penumbra {

struct ProbeQuery {
  Receiver receiver;
  std::size_t light = 0;
};

struct ProbeAnswers {
  std::vector<float> fractions;  ///< one a query
  std::string device;
  std::uint64_t field_steps = 0, unfinished = 0;
  std::vector<std::string> warnings;
};

/// Sampled methods take query i's points by stream i, as the CPU's probe does.
ProbeAnswers probe_field(const gl::Context& context, const Scene& scene, const FieldText& field,
                         const RenderOptions& options, std::span<const ProbeQuery> queries,
                         Progress& progress);

}  // namespace penumbra
