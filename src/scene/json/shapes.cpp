#include <fmt/format.h>

#include "scene/json/builder.h"
#include "scene/json/polygon.h"

namespace penumbra::json {
namespace {

// Four corners, counter-clockwise from the picture's lower left, as two triangles. Texture
// coordinates begin at the picture's upper left.
void append_quad(Mesh& mesh, const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3d& p : {corner, corner + u, corner + u + v, corner + v})
    mesh.positions.emplace_back(p);
  for (const Vec2& uv : {Vec2{0, 1}, Vec2{1, 1}, Vec2{1, 0}, Vec2{0, 0}}) mesh.uv[0].push_back(uv);
  for (const std::uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

Mesh box_mesh(const Vec3& lo, const Vec3& hi) {
  const Vec3d a(lo), b(hi), d = b - a;
  const Vec3d x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
  Mesh mesh;
  append_quad(mesh, a + z, x, y);       // +z
  append_quad(mesh, a + x, -x, y);      // -z
  append_quad(mesh, b - y, -z, y);      // +x
  append_quad(mesh, a, z, y);           // -x
  append_quad(mesh, a + y + z, x, -z);  // +y
  append_quad(mesh, a, x, z);           // -y
  mesh.exact = ExactBox{lo, hi};
  return mesh;
}

std::vector<Vec3d> read_vertices(const Document& document, const Json::Value& list) {
  std::vector<Vec3d> vertices;
  for (const Json::Value& value : list) vertices.emplace_back(point({document, value, "vertices"}));
  return vertices;
}

// One repeat a metre, upright along the first edge, the lower left corner at the first vertex.
void map_in_metres(Mesh& mesh, const std::vector<Vec3d>& vertices, const Vec3d& normal) {
  const Vec3d u = normalize(vertices[1] - vertices[0]);
  const Vec3d v = cross(normal, u);
  for (const Vec3d& p : vertices) {
    const Vec3d d = p - vertices[0];
    mesh.uv[0].push_back({static_cast<float>(dot(d, u)), static_cast<float>(1 - dot(d, v))});
  }
}

// An analytic light is no geometry: it neither blocks light nor is seen.
void turn_into_light(Builder& builder, const Sphere& sphere) {
  Scene& scene = builder.scene;
  Light light;
  light.type = LightType::sphere;
  light.name = scene.objects[sphere.object].name;
  light.position = sphere.center;
  light.radius = sphere.radius;
  light.emission = scene.materials[sphere.material].emission;
  scene.report.conversions.push_back(
      fmt::format("the emissive sphere object \"{}\" became sphere light {}, which is not itself "
                  "seen and blocks no light",
                  light.name, scene.lights.size() + builder.sphere_lights.size()));
  builder.sphere_lights.push_back(std::move(light));
}

}  // namespace

void refuse_parallel_edges(const ObjectReader& reader, const Vec3d& u, const Vec3d& v) {
  if (length(cross(u, v)) < 1e-9 * length(u) * length(v))
    reader.refuse_key("edge_v", "\"edge_u\" and \"edge_v\" are parallel",
                      "give edges that span an area");
}

Mesh quad_mesh(const Vec3d& corner, const Vec3d& u, const Vec3d& v) {
  Mesh mesh;
  append_quad(mesh, corner, u, v);
  mesh.exact = ExactQuad{Vec3(corner), Vec3(u), Vec3(v)};
  return mesh;
}

void read_quad(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const Vec3d corner(reader.required("corner", point));
  const Vec3d u(reader.required("edge_u", nonzero_vector));
  const Vec3d v(reader.required("edge_v", nonzero_vector));
  const std::uint32_t material = required_material(builder, reader);
  reader.done();
  refuse_parallel_edges(reader, u, v);
  add_mesh(builder, quad_mesh(corner, u, v), material, object);
}

void read_sphere(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  Sphere sphere;
  sphere.center = reader.required("center", point);
  sphere.radius = reader.required("radius", positive);
  sphere.material = required_material(builder, reader);
  sphere.object = object;
  reader.done();
  if (builder.scene.materials[sphere.material].emission_map.used())
    sphere.material = untextured(builder, sphere.material, "sphere objects");
  if (max_component(builder.scene.materials[sphere.material].emission) > 0)
    return turn_into_light(builder, sphere);
  sphere.material = untextured(builder, sphere.material, "sphere objects");
  builder.scene.spheres.push_back(sphere);
}

void read_box(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const Vec3 lo = reader.required("min", point);
  const Vec3 hi = reader.required("max", point);
  const std::uint32_t material = required_material(builder, reader);
  reader.done();
  for (int i = 0; i < 3; ++i)
    if (!(lo[i] < hi[i]))
      reader.refuse_key(
          "max", fmt::format("\"max\" of the box does not lie above its \"min\" in {}", "xyz"[i]),
          "give a \"max\" above \"min\" in x, y and z");
  add_mesh(builder, box_mesh(lo, hi), material, object);
}

void read_polygon(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const Json::Value* list = reader.required<const Json::Value*>("vertices", array);
  const std::uint32_t material = required_material(builder, reader);
  reader.done();
  const std::vector<Vec3d> vertices = read_vertices(reader.document(), *list);
  PolygonCut cut = cut_polygon(vertices);
  if (!cut.fault.empty()) reader.refuse_key("vertices", cut.fault, cut.remedy);
  Mesh mesh;
  for (const Vec3d& p : vertices) mesh.positions.emplace_back(p);
  map_in_metres(mesh, vertices, cut.normal);
  mesh.indices = std::move(cut.indices);
  mesh.exact = ExactPolygon{mesh.positions};
  add_mesh(builder, std::move(mesh), material, object);
}

}  // namespace penumbra::json
