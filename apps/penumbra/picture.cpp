#include "picture.h"

#include "baked_light.h"
#include "device.h"
#include "prepare.h"
#include "stored_picture.h"

namespace penumbra::app {

Picture make_picture(Arguments& arguments, const Scene& scene, Console& console) {
  Picture picture;
  if (draws_with_gl(arguments, scene)) {
    adapt_to_gl(arguments, scene, console);
    picture.result = render_gl(scene, arguments.render, arguments.entry, console);
    return picture;
  }
  const Stopwatch build;
  if (arguments.render.shadows.kind == ShadowKind::heckbert_herf && !scene.stores_visibility) {
    const BakedLight baked(scene, arguments, console);
    picture.seconds_build = build.seconds();
    picture.structure_bytes = baked.world().memory_bytes();
    RenderOptions options = arguments.render;
    options.known = &baked.light();
    picture.result = render(baked.world(), options, console);
    return picture;
  }
  const std::unique_ptr<World> world = build_world(scene, arguments, console);
  const auto stored = stored_light(arguments, scene, console);
  picture.seconds_build = build.seconds();
  picture.structure_bytes = world->memory_bytes();
  RenderOptions options = arguments.render;
  options.known = stored.get();
  picture.result = render(*world, options, console);
  return picture;
}

}  // namespace penumbra::app
