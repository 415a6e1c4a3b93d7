#include "bake/receivers.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"

namespace penumbra::bake {
namespace {

std::vector<std::string_view> names_of(const Scene& scene) {
  std::vector<std::string_view> names;
  names.reserve(scene.objects.size());
  for (const Object& object : scene.objects) names.push_back(object.name);
  return names;
}

void check_names(const Scene& scene, const std::vector<std::string>& wanted) {
  const std::vector<std::string_view> names = names_of(scene);
  for (const std::string& name : wanted)
    if (std::ranges::find(names, name) == names.end())
      throw InputError(fmt::format("--receivers: there is no object '{}'", name),
                       names.empty()
                           ? std::string("the scene has no object")
                           : fmt::format("did you mean '{}'?", nearest_name(name, names)));
}

bool holds(const Bounds& box, const Vec3& p) {
  return box.lo.x < p.x && p.x < box.hi.x && box.lo.y < p.y && p.y < box.hi.y && box.lo.z < p.z &&
         p.z < box.hi.z;
}

// Anything that makes a person look, or light shine, inside the box.
bool is_inhabited(const Scene& scene, const WorldMesh& mesh) {
  const Bounds box = bounds_of(scene, mesh.instance());
  for (const Camera& camera : scene.cameras)
    if (holds(box, camera.position)) return true;
  for (const Light& light : scene.lights)
    if (light.type != LightType::sun && light.instance != static_cast<int>(mesh.index()) &&
        holds(box, light.position))
      return true;
  for (const Instance& other : scene.instances)
    if (other.object != mesh.instance().object && holds(box, bounds_of(scene, other).center()))
      return true;
  return false;
}

}  // namespace

std::vector<bool> receivers_of(const Scene& scene, const std::vector<std::string>& names) {
  check_names(scene, names);
  std::vector<bool> receives;
  for (const Instance& instance : scene.instances) {
    const Object& object = scene.objects[instance.object];
    receives.push_back(names.empty() ? object.receives
                                     : std::ranges::find(names, object.name) != names.end());
  }
  if (std::ranges::find(receives, true) == receives.end())
    throw InputError("no surface receives light: there is nothing to bake",
                     "name objects by --receivers, or let one have \"receives\": true");
  return receives;
}

std::vector<float> samples_scales(const Scene& scene) {
  std::vector<float> scales;
  scales.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances)
    scales.push_back(scene.objects[instance.object].samples_scale);
  return scales;
}

bool has_back(const Scene& scene, const WorldMesh& mesh, const Adjacency& adjacency) {
  if (!scene.materials[mesh.instance().material].double_sided) return false;
  const bool is_body = adjacency.is_closed() && signed_volume(mesh) > 0;
  return !is_body || is_inhabited(scene, mesh);
}

}  // namespace penumbra::bake
