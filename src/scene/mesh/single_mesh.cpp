#include "scene/mesh/single_mesh.h"

namespace penumbra {

std::string stem_of(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.substr(0, name.find('.', 1));
}

void add_object(Scene& scene, const std::string& name, Mesh mesh, std::uint32_t material) {
  mesh.name = name;
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  instance.material = material;
  instance.object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({name});
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

}  // namespace penumbra
