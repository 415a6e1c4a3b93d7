// --shadows auto: the method that a small picture of the scene recommends.
#pragma once

#include <json/value.h>

#include "arguments.h"
#include "console.h"

namespace penumbra::app {

/// Measures hard, parker, area and, where the scene has distance fields, the sdf-* methods on a
/// small picture against the truth, takes the one that is fastest at the picture's full size among
/// those whose penumbra error is not above --error (0.05), and puts it into the arguments. Says so.
/// Returns what --stats tells of it. Throws InputError for scenes without a light, and shaders.
Json::Value choose_method(Arguments& arguments, const Scene& scene, Console& console);

}  // namespace penumbra::app
