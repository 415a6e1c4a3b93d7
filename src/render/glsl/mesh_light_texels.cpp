#include "render/glsl/mesh_light_texels.h"

#include "render/light_patches.h"

namespace penumbra {
namespace {

void add_patches(const MeshLight& mesh, int count, std::vector<float>& texels) {
  for (const LightPatch& p : mesh_patches(mesh.faces, count))
    texels.insert(texels.end(), {p.position.x, p.position.y, p.position.z, p.area, p.normal.x,
                                 p.normal.y, p.normal.z, 0});
}

}  // namespace

int add_mesh_light(const MeshLight& mesh, bool double_sided, std::vector<float>& texels) {
  constexpr std::size_t header = 3;
  const std::size_t first = texels.size() / 4;
  std::vector<float> nodes, faces, patches, fine;
  mesh.write_texels(nodes, faces);
  add_patches(mesh, glossy_points, patches);
  // Brightness is in the faces' areas alone, which the closed form does not look at.
  if (mesh.is_textured)
    add_patches(mesh, textured_points, fine);
  else if (mesh.faces.size() > few_faces)
    add_patches(mesh, mesh_points, fine);
  const std::size_t nodes_at = first + header, faces_at = nodes_at + nodes.size() / 4,
                    patches_at = faces_at + faces.size() / 4,
                    fine_at = patches_at + patches.size() / 4;
  const bool all_count = mesh.flat || (double_sided && !mesh.closed);
  for (const std::size_t n : {nodes_at, nodes.size() / 16, faces_at, mesh.faces.size(), patches_at,
                              patches.size() / 8, fine_at, fine.size() / 8})
    texels.push_back(static_cast<float>(n));
  for (const bool flag : {all_count, mesh.flat, double_sided, double_sided && !mesh.closed})
    texels.push_back(flag ? 1.0f : 0.0f);
  for (const auto* part : {&nodes, &faces, &patches, &fine})
    texels.insert(texels.end(), part->begin(), part->end());
  return static_cast<int>(first);
}

}  // namespace penumbra
