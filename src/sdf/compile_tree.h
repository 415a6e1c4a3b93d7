// Writes one tree's code. Internal to the room.
#pragma once

#include <string>

#include "scene/sdf.h"
#include "sdf/tape_writer.h"

namespace penumbra::sdf {

/// `object`: its name, for warnings.
void write_tree(TapeWriter& writer, const SdfTree& tree, const std::string& object,
                const Attach& attach);

}  // namespace penumbra::sdf
