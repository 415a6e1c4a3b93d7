#include <fmt/core.h>

#include <algorithm>

#include "scene/finish.h"
#include "scene/finish_steps.h"

namespace penumbra {
namespace {

constexpr std::size_t kMostParts = 1000;
/// Copies of instanced emissive meshes: some 600 MB of vertices and indices.
constexpr std::size_t kMostCopiedTriangles = 10'000'000;

/// Copies one vertex with all its attributes.
void append_vertex(const Mesh& from, std::uint32_t vertex, Mesh& to) {
  to.positions.push_back(from.positions[vertex]);
  if (!from.normals.empty()) to.normals.push_back(from.normals[vertex]);
  for (int set = 0; set < 2; ++set)
    if (!from.uv[set].empty()) to.uv[set].push_back(from.uv[set][vertex]);
  if (!from.colors.empty()) to.colors.push_back(from.colors[vertex]);
}

/// One mesh a part, each with the vertices it uses.
std::vector<Mesh> split(const Mesh& mesh, const std::vector<std::uint32_t>& part,
                        std::size_t count) {
  std::vector<Mesh> meshes(count);
  for (std::size_t i = 0; i < count; ++i)
    meshes[i].name = fmt::format("{}{}{}", mesh.name, mesh.name.empty() ? "" : " ", i + 1);
  // A vertex belongs to one part only: parts are what shares vertices.
  constexpr std::uint32_t unseen = 0xffffffffu;
  std::vector<std::uint32_t> new_index(mesh.positions.size(), unseen);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    Mesh& to = meshes[part[i / 3]];
    const std::uint32_t vertex = mesh.indices[i];
    if (new_index[vertex] == unseen) {
      new_index[vertex] = static_cast<std::uint32_t>(to.positions.size());
      append_vertex(mesh, vertex, to);
    }
    to.indices.push_back(new_index[vertex]);
  }
  return meshes;
}

/// The centre of mass of a sheet of that shape.
Vec3 area_weighted_centre(const Mesh& mesh) {
  Vec3d sum;
  double area = 0;
  const Vec3d origin(mesh.positions[mesh.indices[0]]);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return Vec3d(mesh.positions[mesh.indices[i + k]]) - origin;
    };
    const Vec3d a = corner(0), b = corner(1), c = corner(2);
    const double weight = length(cross(b - a, c - a));
    sum += (a + b + c) * (weight / 3);
    area += weight;
  }
  return Vec3(origin + sum / area);
}

/// What of a texture's colours is a light of its own: those that it has, or all where it is grey.
std::vector<Vec3> channels_of(const Scene& scene, const Material& material) {
  if (!material.emission_map.used()) return {Vec3(1)};
  const TextureImage& image = scene.textures[static_cast<std::size_t>(material.emission_map.image)];
  bool is_grey = true, has[3] = {false, false, false};
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const std::uint8_t* rgb = &image.rgba[i];
    is_grey = is_grey && rgb[0] == rgb[1] && rgb[1] == rgb[2];
    for (int c = 0; c < 3; ++c) has[c] = has[c] || rgb[c] > 0;
  }
  std::vector<Vec3> channels;
  if (is_grey && has[0]) return {Vec3(1)};
  for (int c = 0; c < 3; ++c) {
    if (!has[c] || !(material.emission[c] > 0)) continue;
    channels.emplace_back();
    channels.back()[c] = 1;
  }
  return channels;
}

void add_light(Scene& scene, std::size_t instance_index) {
  Instance& instance = scene.instances[instance_index];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Material& material = scene.materials[instance.material];
  Light light;
  light.type = LightType::mesh;
  light.name = mesh.name.empty() ? "mesh" : mesh.name;
  light.position = area_weighted_centre(mesh);
  light.double_sided = material.double_sided;
  light.instance = static_cast<int>(instance_index);
  const std::string name = light.name;
  const std::vector<Vec3> channels = channels_of(scene, material);
  if (!channels.empty()) instance.mesh_light = static_cast<int>(scene.lights.size());
  for (const Vec3& channel : channels) {
    light.emission = material.emission * channel;
    if (channel != Vec3(1))
      light.name = name + (channel.x > 0 ? " (red)" : channel.y > 0 ? " (green)" : " (blue)");
    scene.lights.push_back(light);
  }
}

/// The instance keeps the first part; the others become new ones at the end.
void split_instance(Scene& scene, std::size_t instance_index) {
  const Instance instance = scene.instances[instance_index];
  const auto part = connected_parts(scene.meshes[instance.mesh]);
  const std::size_t count = *std::max_element(part.begin(), part.end()) + std::size_t{1};
  const std::string name = quoted_name(scene, instance.mesh);
  if (count > kMostParts)
    scene.report.conversions.push_back(
        fmt::format("the emissive {} has {} separate parts, more than {}: kept as one light", name,
                    count, kMostParts));
  if (count == 1 || count > kMostParts) return add_light(scene, instance_index);

  scene.report.conversions.push_back(
      fmt::format("the emissive {} became {} lights, one per connected part", name, count));
  auto meshes = split(scene.meshes[instance.mesh], part, count);
  for (std::size_t i = 0; i < count; ++i) {
    if (i == 0) {
      scene.meshes[instance.mesh] = std::move(meshes[0]);
      add_light(scene, instance_index);
      continue;
    }
    scene.instances.push_back(instance);
    scene.instances.back().mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(meshes[i]));
    add_light(scene, scene.instances.size() - 1);
  }
}

bool emits(const Scene& scene, const Instance& instance) {
  return is_light_material(scene.materials[instance.material]);
}

}  // namespace

bool is_light_material(const Material& material) {
  return max_component(material.emission) > 0 &&
         (!material.emission_map.used() || material.emission_map_lights);
}

void unshare_emissive_meshes(Scene& scene) {
  std::vector<std::uint32_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  std::size_t copied = 0;
  for (Instance& instance : scene.instances) {
    if (!emits(scene, instance) || uses[instance.mesh] == 1) continue;
    const std::size_t triangles = scene.meshes[instance.mesh].triangle_count();
    if (copied + triangles > kMostCopiedTriangles) continue;
    copied += triangles;
    --uses[instance.mesh];
    scene.meshes.push_back(scene.meshes[instance.mesh]);
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size() - 1);
    uses.push_back(1);
  }
}

void add_mesh_lights(Scene& scene) {
  std::vector<std::uint32_t> uses(scene.meshes.size());
  for (const Instance& instance : scene.instances) ++uses[instance.mesh];
  const std::size_t count = scene.instances.size();
  std::size_t skipped = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!emits(scene, scene.instances[i])) continue;
    if (uses[scene.instances[i].mesh] == 1)
      split_instance(scene, i);
    else
      ++skipped;
  }
  if (skipped > 0)
    scene.report.warnings.push_back(
        fmt::format("{} instances of large emissive meshes glow without lighting the scene, to "
                    "save memory",
                    skipped));
}

}  // namespace penumbra
