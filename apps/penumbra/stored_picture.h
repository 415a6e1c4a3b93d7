// Pictures of files that hold what is seen of their lights.
#pragma once

#include <memory>

#include "arguments.h"
#include "bake/stored_light.h"
#include "console.h"

namespace penumbra::app {

/// A file with visibility in it is shown by it unless another method is named.
void prefer_stored(Arguments& arguments, const Scene& scene, Console& console);

/// What the file knows of its lights, if that is to be shown; else null. Throws InputError.
std::unique_ptr<bake::StoredLight> stored_light(const Arguments& arguments, const Scene& scene,
                                                Console& console);

}  // namespace penumbra::app
