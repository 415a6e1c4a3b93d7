#include "bake/triangulate.h"

#include <array>
#include <map>
#include <numbers>

#include "sdf/field.h"
#include "sdf/mesher.h"

namespace penumbra::bake {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct Solid {
  std::vector<Vec3> points;  ///< on the unit sphere
  std::vector<Triangle> triangles;
};

Solid icosahedron() {
  const float g = std::numbers::phi_v<float>;
  Solid s;
  for (const Vec3& p : {Vec3{-1, g, 0},
                        {1, g, 0},
                        {-1, -g, 0},
                        {1, -g, 0},
                        {0, -1, g},
                        {0, 1, g},
                        {0, -1, -g},
                        {0, 1, -g},
                        {g, 0, -1},
                        {g, 0, 1},
                        {-g, 0, -1},
                        {-g, 0, 1}})
    s.points.push_back(normalize(p));
  s.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                 {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                 {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                 {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  return s;
}

Solid subdivided(const Solid& in) {
  Solid out{in.points, {}};
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, is_new] = middles.try_emplace(std::minmax(a, b), 0u);
    if (is_new) {
      it->second = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(normalize(in.points[a] + in.points[b]));
    }
    return it->second;
  };
  for (const auto& [a, b, c] : in.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      out.triangles.push_back(t);
  }
  return out;
}

const Solid& round_solid() {
  static const Solid solid = [] {
    Solid s = icosahedron();
    for (int i = 0; i < 4; ++i) s = subdivided(s);
    return s;
  }();
  return solid;
}

Mesh mesh_of(const Sphere& sphere) {
  Mesh mesh;
  for (const Vec3& p : round_solid().points) {
    mesh.positions.push_back(sphere.center + p * sphere.radius);
    mesh.normals.push_back(p);
  }
  for (const Triangle& t : round_solid().triangles)
    mesh.indices.insert(mesh.indices.end(), t.begin(), t.end());
  return mesh;
}

void add(Scene& scene, Mesh mesh, std::uint32_t material, std::uint32_t object) {
  mesh.name = scene.objects[object].name;
  const auto index = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({index, material, object, -1, {}});
}

}  // namespace

Scene triangulated(const Scene& scene, const sdf::ConversionOptions& conversions) {
  Scene out = scene;
  for (const Sphere& sphere : scene.spheres)
    add(out, mesh_of(sphere), sphere.material, sphere.object);
  out.spheres.clear();
  if (scene.sdfs.empty()) return out;
  sdf::FieldOptions options;
  options.only_distance_fields = true;
  const sdf::Field field(scene, options);
  for (auto& part : sdf::meshes_of_field(field, conversions.bounds, {conversions.voxel_size}))
    add(out, std::move(part.mesh), part.material, part.object);
  out.sdfs.clear();
  return out;
}

}  // namespace penumbra::bake
