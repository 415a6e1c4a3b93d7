// The renderers of the program behind report::Drawer.
#pragma once

#include "arguments.h"
#include "report/drawer.h"

namespace penumbra::app {

/// Draws by the device that the arguments name, OpenGL or this processor, and bakes first for
/// heckbert-herf. Keeps a copy of the arguments.
report::MakeDrawer drawers_for(const Arguments& arguments);

/// What happens to the scene for a method, line by line, for people.
std::vector<std::string> conversions_for(const Scene& scene, const Arguments& arguments,
                                         ShadowKind kind);

/// The method with what of the options belongs to it: a variant of another is left out.
RenderOptions options_for(ShadowKind kind, const Arguments& arguments);

/// A World that the reference can be found in.
std::unique_ptr<World> reference_world(const Scene& scene);

/// The options of the picture that stands for the truth: as many points of the light as it takes.
RenderOptions reference_picture(const Arguments& arguments);

/// The scene as prepare_scene() left it, with its lights changed.
report::ChangeLights change_lights(const Scene& scene);

}  // namespace penumbra::app
