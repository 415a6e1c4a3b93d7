#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/load.h"
#include "scene/mesh/mtl.h"
#include "scene/mesh/obj_statements.h"
#include "scene/mesh/polygon.h"
#include "scene/mesh/single_mesh.h"
#include "scene/mesh/weld.h"

namespace penumbra {
namespace {

/// The corners of each group's triangles.
std::vector<std::vector<ObjCorner>> triangulate_groups(const ObjStatements& obj) {
  std::vector<std::vector<ObjCorner>> groups(obj.groups.size());
  std::vector<Vec3> polygon;
  std::vector<std::uint32_t> local;
  for (const ObjFace& face : obj.faces) {
    const ObjCorner* corners = &obj.corners[face.first_corner];
    polygon.clear(), local.clear();
    for (std::uint32_t i = 0; i < face.corner_count; ++i)
      polygon.push_back(obj.positions[corners[i][0]]);
    triangulate(polygon, local);
    for (const std::uint32_t l : local) groups[face.group].push_back(corners[l]);
  }
  return groups;
}

bool any_has(const std::vector<ObjCorner>& corners, int attribute) {
  for (const ObjCorner& c : corners)
    if (c[attribute] != kNoAttribute) return true;
  return false;
}

/// Corners that agree in all attributes become one vertex.
Mesh mesh_of(const ObjStatements& obj, const std::vector<ObjCorner>& corners) {
  Weld weld = weld_triples(corners);
  Mesh mesh;
  const bool has_uv = any_has(corners, 1), has_normals = any_has(corners, 2);
  for (const std::uint32_t first : weld.first) {
    const auto [v, vt, vn] = corners[first];
    mesh.positions.push_back(obj.positions[v]);
    // The file's v goes up, textures begin with the top row.
    if (has_uv)
      mesh.uv[0].push_back(vt == kNoAttribute ? Vec2{}
                                              : Vec2{obj.texcoords[vt].x, 1 - obj.texcoords[vt].y});
    // finish_scene makes a normal of the triangles around where there is none.
    if (has_normals) mesh.normals.push_back(vn == kNoAttribute ? Vec3{} : obj.normals[vn]);
  }
  mesh.indices = std::move(weld.id);
  return mesh;
}

void add_meshes(const ObjStatements& obj, const std::string& stem, MaterialLibraries& libraries,
                Scene& scene) {
  for (const std::string& name : obj.objects) scene.objects.push_back({name.empty() ? stem : name});
  auto corners = triangulate_groups(obj);
  for (std::size_t g = 0; g < corners.size(); ++g) {
    const std::string& material = obj.materials[obj.groups[g].material];
    Instance instance;
    instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    instance.object = obj.groups[g].object;
    instance.material = material.empty() ? libraries.default_material() : libraries.find(material);
    scene.meshes.push_back(mesh_of(obj, corners[g]));
    scene.meshes.back().name = scene.objects[instance.object].name;
    scene.instances.push_back(instance);
    corners[g] = {};
  }
}

}  // namespace

Scene read_obj(const std::string& path) {
  const std::string text = read_file(path);
  const ObjStatements obj = read_obj_statements(path, text);
  if (obj.corners.size() >= std::size_t{1} << 29)  // at most three times as many after cutting
    throw InputError({path}, "has more faces than one scene can hold",
                     "split the model into several files");
  Scene scene;
  scene.report.format = "Wavefront OBJ";
  scene.report.warnings = obj.warnings;
  MaterialLibraries libraries(scene);
  for (const std::string& names : obj.libraries)
    libraries.load(path.substr(0, path.find_last_of('/') + 1), names);
  add_meshes(obj, stem_of(path), libraries, scene);
  return scene;
}

}  // namespace penumbra
