// The part of the scene schema that describes distance fields, made from the table of signatures.
#pragma once

#include <string>

#include "scene/sdf.h"

namespace penumbra {

/// Definitions for "$defs", each followed by a comma: "sdf_node", "sdf_profile" and "sdf_OP" of
/// every op.
std::string sdf_schema();

/// The rows of the manual's table, `| op | parameters | meaning |` for each op of the kind.
std::string sdf_manual_rows(SdfKind kind);

}  // namespace penumbra
