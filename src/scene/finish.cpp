#include "scene/finish.h"

#include "base/error.h"
#include "scene/finish_steps.h"

namespace penumbra {

void finish_scene(Scene& scene, const std::string& file) {
  check_geometry(scene, file);
  check_cameras_and_lights(scene, file);
  unshare_emissive_meshes(scene);
  bake_transforms(scene);
  drop_degenerate(scene);
  repair_attributes(scene);
  if (scene.instances.empty() && scene.spheres.empty() && scene.sdfs.empty() && !scene.glsl)
    throw InputError({file}, "contains no triangle and no sphere",
                     "name a file with something to render");
  add_mesh_lights(scene);
}

}  // namespace penumbra
