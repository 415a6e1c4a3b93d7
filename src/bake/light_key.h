// By what a stored light is known again.
#pragma once

#include <json/value.h>

#include "scene/scene.h"

namespace penumbra::bake {

/// Type, place and size of a light; not its name and emission, which may change.
Json::Value light_key(const Light& light);

/// True if the light is as the key has it, within 1e-4 of `extent`, the size of the scene in metres
/// (directions: of 1), and within 0.1 % of its size. `key` may be any JSON.
bool is_light(const Json::Value& key, const Light& light, float extent);

}  // namespace penumbra::bake
