#include "stored_picture.h"

#include <fmt/format.h>

#include <algorithm>

namespace penumbra::app {
namespace {

bool has(const Arguments& arguments, const char* option) {
  return std::ranges::find(arguments.given, option) != arguments.given.end();
}

}  // namespace

void prefer_stored(Arguments& arguments, const Scene& scene, Console& console) {
  ShadowKind& kind = arguments.render.shadows.kind;
  if (!scene.stores_visibility) return;
  if (!has(arguments, "--shadows") && arguments.device != Device::gl)
    kind = ShadowKind::heckbert_herf;
  if (kind != ShadowKind::heckbert_herf) return;
  for (const char* option : {"--light-samples", "--texel-size", "--sample-grid"})
    if (has(arguments, option))
      console.warn(fmt::format("{} has no effect: the file holds baked visibility", option));
}

std::unique_ptr<bake::StoredLight> stored_light(const Arguments& arguments, const Scene& scene,
                                                Console& console) {
  const bool is_shown = arguments.render.shadows.kind == ShadowKind::heckbert_herf;
  if (!is_shown || !scene.stores_visibility) return nullptr;
  auto stored = std::make_unique<bake::StoredLight>(arguments.scene, scene);
  console.remark(fmt::format("shadows: {} stored in the file", stored->what()));
  return stored;
}

}  // namespace penumbra::app
