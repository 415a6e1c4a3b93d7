// The files of a bake.
#pragma once

#include <string>

#include "arguments.h"
#include "bake/bake.h"

namespace penumbra::app {

/// Names of the files beside OUT.glb: OUT.exr, with -1, -2 … before the dot where there are several
/// pages; OUT.json.
std::string page_file(const Arguments& arguments, int page, std::size_t pages);
std::string description_file(const Arguments& arguments);

/// Writes the .glb, and the description and the preview if they are wanted; throws WorkError.
void write_baked(const Arguments& arguments, const bake::Baked& baked);

}  // namespace penumbra::app
