#include "sdf/glsl/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "sdf/glsl/mesh_texels.h"
#include "sdf/glsl/numbers.h"
#include "sdf/glsl/shader_text.h"
#include "sdf/glsl/tree_text.h"

namespace penumbra::sdf {
namespace {

std::string comment(const std::string& name) {
  std::string text = name;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\') c = ' ';
  return text;
}

class SceneText {
 public:
  SceneText(const Scene& scene, const MeshDistances& meshes) : scene_(scene), meshes_(meshes) {}

  GlslField write() {
    field_.text = sdf_shader_text("shapes.glsl");
    for (std::size_t i = 0; i < scene_.sdfs.size(); ++i) add_tree(i);
    for (const Sphere& s : scene_.spheres)
      add_solid(fmt::format("pnb_sd_sphere(p - {}, {})", vector(Vec3d(s.center)), number(s.radius)),
                s.material, s.object);
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) add_mesh(i);
    if (grids_ > 0) field_.text.insert(0, sdf_shader_text("mesh.glsl"));
    field_.mesh_texels = texels_.take();
    field_.text += "\n// The whole field.\nfloat pnb_scene(vec3 p) {\n  float d = 1e30;\n" +
                   values_ + "  return d;\n}\n";
    field_.text += surfaces_ == values_
                       ? "#define pnb_scene_surface pnb_scene\n#define pnb_scene_signed pnb_scene\n"
                       : "\n// As surfaces: only sdf objects have an inside.\n"
                         "float pnb_scene_surface(vec3 p) {\n  float d = 1e30;\n" +
                             surfaces_ +
                             "  return d;\n}\n\n// The object whose surface is nearest alone.\n"
                             "float pnb_scene_signed(vec3 p) {\n  float d = 1e30;\n" +
                             signed_ + "  return d;\n}\n";
    field_.text +=
        "\n// What the surface nearest to p is made of, and pnb_scene_surface(p).\n"
        "pnb_Material pnb_scene_material(vec3 p, out float d) {\n  pnb_Material m, o;\n"
        "  float e;\n  d = 1e30;\n" +
        shades_ + "  return m;\n}\n";
    return std::move(field_);
  }

 private:
  void add_tree(std::size_t index) {
    const SdfTree& tree = scene_.sdfs[index];
    const std::string name = fmt::format("pnb_object{}", index);
    TreeText text(tree, name, scene_.objects[tree.object].name, field_.warnings);
    field_.text += text.value_functions();
    values_ += fmt::format("  d = min(d, {}(p));\n", name);
    surfaces_ += fmt::format("  d = min(d, {}(p));\n", name);
    signed_ += fmt::format("  d = pnb_nearer(d, {}(p));\n", name);
    if (text.has_one_material()) {
      add_shade(name + "(p)", tree.nodes.back().material);
      return;
    }
    field_.text += text.shade_functions();
    shades_ += fmt::format("  e = {}_shade(p, o);\n  if (e < d) d = e, m = o;\n", name);
  }

  /// `own`: the instance that pnb_own may take out, or −1.
  void add_shape(const std::string& value, const std::string& surface, std::uint32_t material,
                 std::uint32_t object, int own = -1) {
    const std::string name = comment(scene_.objects[object].name);
    values_ += fmt::format("  d = min(d, {});  // {}\n", value, name);
    const std::string unless = own < 0 ? "" : fmt::format("if (pnb_own != {}) ", own);
    surfaces_ += fmt::format("  {}d = min(d, {});  // {}\n", unless, surface, name);
    signed_ += fmt::format("  d = pnb_nearer(d, {});  // {}\n", value, name);
    add_shade(surface, material);
  }

  void add_solid(const std::string& value, std::uint32_t material, std::uint32_t object,
                 int own = -1) {
    add_shape(value, "abs(" + value + ")", material, object, own);
  }

  void add_shade(const std::string& value, std::uint32_t material) {
    shades_ +=
        fmt::format("  e = {};\n  if (e < d) d = e, m = pnb_material_of({});\n", value, material);
  }

  int own_of(const Instance& instance) const {
    return instance.mesh_light < 0 ? -1 : static_cast<int>(&instance - scene_.instances.data());
  }

  void add_mesh(std::size_t index) {
    const Instance& instance = scene_.instances[index];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    if (const auto* box = std::get_if<ExactBox>(&mesh.exact)) {
      const Vec3d lo(box->lo), hi(box->hi);
      return add_solid(
          fmt::format("pnb_sd_box(p - {}, {})", vector((lo + hi) * 0.5), vector((hi - lo) * 0.5)),
          instance.material, instance.object, own_of(instance));
    }
    if (const auto* q = std::get_if<ExactQuad>(&mesh.exact))
      return add_outline({q->corner, q->corner + q->edge_u, q->corner + q->edge_u + q->edge_v,
                          q->corner + q->edge_v},
                         instance);
    if (const auto* polygon = std::get_if<ExactPolygon>(&mesh.exact))
      return add_outline(polygon->vertices, instance);
    if (!meshes_)
      throw InputError(fmt::format("the mesh \"{}\" has no formula for a shader", mesh.name),
                       "use spheres, boxes, quads, polygons and sdf objects");
    owned_.push_back(meshes_(scene_, index));
    if (owned_.back()) add_grid(instance, *owned_.back());
  }

  void add_grid(const Instance& instance, const MeshDistance& distances) {
    const auto placed = distances.placed_grid();
    if (!placed) return;
    const Mesh& mesh = scene_.meshes[instance.mesh];
    const MeshGrid::Frame frame = placed->grid->frame();
    const Affine& from_world = placed->grid_from_world;
    const double unit = 1 / frame.side;
    const std::string name = fmt::format("pnb_mesh{}", grids_++);
    field_.text += fmt::format(
        "\nfloat {}(vec3 p, bool with_sign) {{  // {}\n"
        "  vec3 q = mat3({}, {}, {}) * p + {};\n"
        "  return {} * pnb_grid({}, q, with_sign);\n}}\n",
        name, comment(scene_.objects[instance.object].name), vector(Vec3d(from_world.x) * unit),
        vector(Vec3d(from_world.y) * unit), vector(Vec3d(from_world.z) * unit),
        vector((Vec3d(from_world.point(Vec3d())) - frame.center) * unit),
        number(placed->scale * frame.side), texels_.add(*placed->grid));
    add_shape(name + "(p, true)", name + "(p, false)", instance.material, instance.object,
              own_of(instance));
    if (!mesh.normals.empty())
      warn_once(fmt::format("the mesh \"{}\" is shown without its vertex normals in shaders",
                            comment(mesh.name)));
  }

  void warn_once(const std::string& text) {
    auto& warnings = field_.warnings;
    if (std::find(warnings.begin(), warnings.end(), text) == warnings.end())
      warnings.push_back(text);
  }

  // A flat polygon in its own frame: u along its first edge, w its normal.
  void add_outline(const std::vector<Vec3>& vertices, const Instance& instance) {
    const Vec3d origin(vertices[0]);
    Vec3d normal;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      normal +=
          cross(Vec3d(vertices[i]) - origin, Vec3d(vertices[(i + 1) % vertices.size()]) - origin);
    const Vec3d w = normalize(normal), u = normalize(Vec3d(vertices[1]) - origin), v = cross(w, u);
    std::vector<double> flat;
    for (const Vec3& p : vertices) {
      flat.push_back(dot(Vec3d(p) - origin, u));
      flat.push_back(dot(Vec3d(p) - origin, v));
    }
    const std::string name = fmt::format("pnb_outline{}", flats_++);
    field_.text += '\n' + outline_function(name + "_outline", flat);
    field_.text += fmt::format(
        "\nfloat {0}(vec3 p) {{  // {1}\n  vec3 q = (p - {2}) * mat3({3}, {4}, {5});\n"
        "  return pnb_sheet({0}_outline(q.xy), q.z);\n}}\n",
        name, comment(scene_.objects[instance.object].name), vector(origin), vector(u), vector(v),
        vector(w));
    add_shape(name + "(p)", name + "(p)", instance.material, instance.object, own_of(instance));
  }

  const Scene& scene_;
  const MeshDistances& meshes_;
  GlslField field_;
  MeshTexels texels_;
  std::vector<std::shared_ptr<const MeshDistance>> owned_;  // so that grids keep their addresses
  std::string values_, surfaces_, signed_, shades_;
  int flats_ = 0, grids_ = 0;
};

}  // namespace

bool has_shapes(const Scene& scene) {
  return !scene.sdfs.empty() || !scene.spheres.empty() || !scene.instances.empty();
}

GlslField generate_glsl(const Scene& scene, const MeshDistances& meshes) {
  return SceneText(scene, meshes).write();
}

}  // namespace penumbra::sdf
