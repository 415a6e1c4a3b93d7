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
    for (std::size_t i = 0; i < scene_.instances.size(); ++i) add_instance(i);
    if (!texels_.empty()) add_meshes();
    const bool alike = surfaces_ == values_ && !field_.has_meshes;
    add_function("The whole field.", "pnb_scene", values_, "true, false");
    if (alike)
      field_.text +=
          "#define pnb_scene_surface pnb_scene\n#define pnb_scene_signed pnb_scene\n"
          "#define pnb_scene_shapes pnb_scene\n";
    if (!alike) {
      add_function("As surfaces: only sdf objects have an inside.", "pnb_scene_surface", surfaces_,
                   "false, false");
      add_function("The object whose surface is nearest alone.", "pnb_scene_signed", signed_,
                   "true, true");
      field_.text += "\n// The surfaces without meshes.\n";
      field_.text += field_.has_meshes ? "float pnb_scene_shapes(vec3 p) {\n  float d = 1e30;\n" +
                                             surfaces_ + "  return d;\n}\n"
                                       : "#define pnb_scene_shapes pnb_scene_surface\n";
    }
    add_rounded();
    field_.text +=
        "\n// What the surface nearest to p is made of, and pnb_scene_shapes(p).\n"
        "pnb_Material pnb_scene_material(vec3 p, out float d) {\n"
        "  pnb_Material m = pnb_material_of(-1), o;\n  float e;\n  d = 1e30;\n" +
        shades_ + "  return m;\n}\n";
    return std::move(field_);
  }

 private:
  // `meshes`: how they take part, see pnb_with_meshes.
  void add_function(const std::string& what, const std::string& name, const std::string& body,
                    const std::string& meshes) {
    field_.text += fmt::format(
        "\n// {}\nfloat {}(vec3 p) {{\n  float d = 1e30;\n{}  return {};\n}}\n", what, name, body,
        field_.has_meshes ? fmt::format("pnb_with_meshes(p, d, {})", meshes) : "d");
  }

  void add_meshes() {
    field_.has_meshes = true;
    const int first = texels_.finish();
    field_.mesh_texels = texels_.take();
    field_.text += fmt::format(
        "\n#define PNB_MESHES\nuniform highp sampler2D pnb_mesh_texels;\n"
        "const int pnb_first_mesh = {};  // the texel that their records follow\n\n"
        "vec4 pnb_texel(int i) {{ return texelFetch(pnb_mesh_texels, ivec2(i & 4095, i >> 12), 0); "
        "}}\n\n",
        first);
    field_.text += sdf_shader_text("mesh.glsl");
  }

  void add_rounded() {
    field_.text +=
        "\n// True where an sdf object is nearest.\nbool pnb_scene_is_rounded(vec3 p) {\n";
    if (trees_.empty() || others_.empty())
      field_.text += others_.empty() ? "  return true;\n}\n" : "  return false;\n}\n";
    else
      field_.text += "  float d = 1e30, e = 1e30;\n" + trees_ + others_ + "  return d <= e;\n}\n";
  }

  void add_tree(std::size_t index) {
    const SdfTree& tree = scene_.sdfs[index];
    const std::string name = fmt::format("pnb_object{}", index);
    TreeText text(tree, name, scene_.objects[tree.object].name, field_.warnings);
    field_.text += text.value_functions();
    values_ += fmt::format("  d = min(d, {}(p));\n", name);
    surfaces_ += fmt::format("  d = min(d, {}(p));\n", name);
    trees_ += fmt::format("  d = min(d, {}(p));\n", name);
    signed_ += fmt::format("  d = pnb_nearer(d, {}(p));\n", name);
    if (text.has_one_material()) {
      add_shade(name + "(p)", tree.nodes.back().material);
      return;
    }
    field_.text += text.shade_functions();
    shades_ += fmt::format("  e = {}_shade(p, o);\n  if (e < d) d = e, m = o;\n", name);
  }

  /// `own`: the instance that pnb_left_out may take out, or −1.
  void add_shape(const std::string& value, const std::string& surface, std::uint32_t material,
                 std::uint32_t object, int own = -1) {
    const std::string name = comment(scene_.objects[object].name);
    values_ += fmt::format("  d = min(d, {});  // {}\n", value, name);
    const std::string unless = own < 0 ? "" : fmt::format("if (pnb_left_out != {}) ", own);
    surfaces_ += fmt::format("  {}d = min(d, {});  // {}\n", unless, surface, name);
    others_ += fmt::format("  e = min(e, {});  // {}\n", surface, name);
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

  // What it shows depends on more than the place.
  static bool needs_facets(const Material& m) {
    return (m.alpha_cutoff && m.diffuse_map.used()) || m.diffuse_map.used() ||
           m.metallic_roughness_map.used() || m.emission_map.used() ||
           (!m.double_sided && max_component(m.emission) > 0);
  }

  int own_of(const Instance& instance) const {
    return instance.mesh_light < 0 ? -1 : static_cast<int>(&instance - scene_.instances.data());
  }

  void add_instance(std::size_t index) {
    const Instance& instance = scene_.instances[index];
    const Mesh& mesh = scene_.meshes[instance.mesh];
    const bool has_formula = !std::holds_alternative<std::monostate>(mesh.exact);
    if (has_formula && meshes_ && needs_facets(scene_.materials[instance.material]))
      texels_.add_triangles(scene_, index);
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
      throw InputError(
          fmt::format(
              "the mesh \"{}\" is too much for a shader that stands alone: its triangles and "
              "their distance grid go to OpenGL in a texture, which Shadertoy does not take",
              mesh.name),
          "draw the scene by penumbra render --device gl, or export it with spheres, boxes, quads, "
          "polygons and sdf objects in the mesh's place");
    owned_.push_back(meshes_(scene_, index));
    if (!owned_.back()) return;
    if (const auto placed = owned_.back()->placed_grid()) texels_.add(scene_, index, *placed);
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
  std::string trees_, others_;  // surfaces_ in two
  int flats_ = 0;
};

}  // namespace

bool has_shapes(const Scene& scene) {
  return !scene.sdfs.empty() || !scene.spheres.empty() || !scene.instances.empty();
}

GlslField generate_glsl(const Scene& scene, const MeshDistances& meshes) {
  return SceneText(scene, meshes).write();
}

}  // namespace penumbra::sdf
