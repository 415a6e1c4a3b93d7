// `penumbra new`: a commented scene to begin from, and the schema that describes the format.
#pragma once

#include <string_view>

namespace penumbra {

std::string_view starter_scene();  ///< JSON with // comments; renders as it is
std::string_view scene_schema();   ///< JSON Schema, draft 2020-12; also docs/scene.schema.json

}  // namespace penumbra
