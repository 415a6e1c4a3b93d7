#include "scene/gltf/primitive.h"

#include <fmt/format.h>

#include <limits>
#include <numeric>

#include "scene/gltf/accessor.h"
#include "scene/gltf/triangulate.h"
#include "scene/gltf/values.h"

namespace penumbra::gltf {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr int kUnsignedInt = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;

/// Reads one primitive; path_ is where it stands in the file.
class Reader {
 public:
  Reader(Document& document, std::size_t mesh, std::size_t primitive)
      : document_(document),
        mesh_(document.model().meshes[mesh]),
        primitive_(mesh_.primitives[primitive]),
        indices_(document.indices_of(mesh, primitive)),
        path_(fmt::format("meshes[{}].primitives[{}]", mesh, primitive)) {}

  std::optional<Mesh> read();

 private:
  bool has_triangles() const;
  Elements attribute(const std::string& name, int components) const;
  std::optional<Elements> vertex_attribute(const std::string& name, int components) const;
  Indices indices() const;
  Indices read_indices(const Elements& elements) const;
  std::vector<Vec3> vectors(const Elements& elements, const Indices& vertices) const;
  void read_uvs(Mesh& mesh, const Indices& vertices) const;
  void read_colors(Mesh& mesh, const Indices& vertices) const;
  void warn_of_deformation() const;

  Document& document_;
  const tinygltf::Mesh& mesh_;
  const tinygltf::Primitive& primitive_;
  int indices_;
  std::string path_;
  std::size_t vertex_count_ = 0;
};

bool Reader::has_triangles() const {
  const bool triangles = primitive_.mode >= TINYGLTF_MODE_TRIANGLES;
  const bool positions = primitive_.attributes.contains("POSITION");
  if (!triangles) document_.warnings().add("points and lines are left out", path_);
  if (triangles && !positions)
    document_.warnings().add("a primitive without positions is left out", path_);
  return triangles && positions;
}

Elements Reader::attribute(const std::string& name, int components) const {
  const std::string path = path_ + ".attributes." + name;
  Elements elements(document_, primitive_.attributes.at(name));
  if (elements.components() != components)
    throw document_.json().error(path, fmt::format("must be a VEC{}", components));
  if (elements.component_type() == kUnsignedInt)
    throw document_.json().error(path, "must not be of 32-bit integers");
  return elements;
}

std::optional<Elements> Reader::vertex_attribute(const std::string& name, int components) const {
  if (!primitive_.attributes.contains(name)) return std::nullopt;
  Elements elements = attribute(name, components);
  if (elements.count() != vertex_count_)
    throw document_.json().error(
        path_ + ".attributes." + name,
        fmt::format("has {} elements for {} vertices", elements.count(), vertex_count_));
  return elements;
}

Indices Reader::indices() const {
  if (indices_ >= 0) return read_indices(Elements(document_, indices_));
  document_.spend(vertex_count_ * sizeof(std::uint32_t), path_);
  Indices all(vertex_count_);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

Indices Reader::read_indices(const Elements& elements) const {
  const std::string path = path_ + ".indices";
  const int type = elements.component_type();
  // Of the types' numbers those of the unsigned integers are odd.
  if (elements.components() != 1 || type % 2 == 0)
    throw document_.json().error(path, "must be a SCALAR of unsigned integers");
  document_.spend(elements.count() * sizeof(std::uint32_t), path);
  Indices list(elements.count());
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i] = elements.get_index(i);
    if (list[i] >= vertex_count_)
      throw document_.json().error(path, fmt::format("index {} is {}, but there are {} vertices", i,
                                                     list[i], vertex_count_));
  }
  return list;
}

std::vector<Vec3> Reader::vectors(const Elements& elements, const Indices& vertices) const {
  document_.spend(vertices.size() * sizeof(Vec3), path_);
  std::vector<Vec3> result(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    float v[3];
    elements.get(vertices[i], v);
    result[i] = {v[0], v[1], v[2]};
  }
  return result;
}

void Reader::read_uvs(Mesh& mesh, const Indices& vertices) const {
  for (int set = 0; set < 2; ++set) {
    const auto elements = vertex_attribute(fmt::format("TEXCOORD_{}", set), 2);
    if (!elements) continue;
    document_.spend(vertices.size() * sizeof(Vec2), path_);
    for (const std::uint32_t vertex : vertices) {
      float v[2];
      elements->get(vertex, v);
      mesh.uv[set].push_back({v[0], v[1]});
    }
  }
}

/// COLOR_0 of three components, or of four, whose alpha is not read.
void Reader::read_colors(Mesh& mesh, const Indices& vertices) const {
  const auto found = primitive_.attributes.find("COLOR_0");
  if (found == primitive_.attributes.end()) return;
  const bool has_alpha = Elements(document_, found->second).components() == 4;
  const auto elements = vertex_attribute("COLOR_0", has_alpha ? 4 : 3);
  document_.spend(vertices.size() * sizeof(Vec3), path_);
  for (const std::uint32_t vertex : vertices) {
    float v[4];
    elements->get(vertex, v);
    mesh.colors.push_back({to_unit(v[0]), to_unit(v[1]), to_unit(v[2])});
  }
}

void Reader::warn_of_deformation() const {
  if (!primitive_.targets.empty())
    document_.warnings().add("morph targets are left out: the mesh is shown undeformed",
                             mesh_.name);
}

std::optional<Mesh> Reader::read() {
  if (!has_triangles()) return std::nullopt;
  warn_of_deformation();
  const Elements positions = attribute("POSITION", 3);
  vertex_count_ = positions.count();
  if (vertex_count_ > std::numeric_limits<std::uint32_t>::max())
    throw document_.json().error(path_ + ".attributes.POSITION", "has more than 2^32 vertices");
  Mesh mesh;
  mesh.name = mesh_.name;
  Indices vertices = indices();
  document_.spend(vertices.size() * 3 * sizeof(std::uint32_t), path_);
  mesh.indices = triangle_list(std::move(vertices), primitive_.mode);
  const Indices used = compact(mesh.indices);
  mesh.positions = vectors(positions, used);
  if (const auto normals = vertex_attribute("NORMAL", 3)) mesh.normals = vectors(*normals, used);
  read_uvs(mesh, used);
  read_colors(mesh, used);
  return mesh;
}

}  // namespace

std::optional<Mesh> read_primitive(Document& document, std::size_t mesh, std::size_t primitive) {
  return Reader(document, mesh, primitive).read();
}

}  // namespace penumbra::gltf
