// Output files: checked before the work, written after it.
#pragma once

#include "arguments.h"
#include "render/render.h"

namespace penumbra::app {

/// True if the name ends in `extension`, in any case.
bool has_extension(const std::string& file, const std::string& extension);

/// Throws InputError for a name that says no known format or that is used twice, WorkError for a
/// file that could not be written.
void check_outputs(const Arguments& arguments);

/// Writes the picture and the AOVs; throws WorkError.
void write_outputs(const Arguments& arguments, const Scene& scene, const RenderResult& result);

}  // namespace penumbra::app
