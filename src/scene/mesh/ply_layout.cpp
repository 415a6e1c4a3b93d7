#include "scene/mesh/ply_layout.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "scene/mesh/polygon.h"

namespace penumbra {
namespace {

int attribute_of(std::string_view name) {
  constexpr std::pair<std::string_view, int> names[] = {
      {"x", ply_x},   {"y", ply_y},   {"z", ply_z},         {"nx", ply_nx},
      {"ny", ply_ny}, {"nz", ply_nz}, {"s", ply_s},         {"t", ply_t},
      {"u", ply_s},   {"v", ply_t},   {"texture_u", ply_s}, {"texture_v", ply_t}};
  for (const auto& [known, attribute] : names)
    if (known == name) return attribute;
  return -1;
}

std::size_t find_element(const PlyHeader& header, std::string_view name) {
  const auto found = std::find_if(header.elements.begin(), header.elements.end(),
                                  [&](const PlyElement& e) { return e.name == name; });
  return static_cast<std::size_t>(found - header.elements.begin());
}

void map_vertex(const std::string& file, const PlyElement& vertex, PlyLayout& layout) {
  bool has[ply_attributes] = {};
  for (const PlyProperty& property : vertex.properties) {
    const int attribute = property.is_list ? -1 : attribute_of(property.name);
    layout.attribute.push_back(attribute);
    if (attribute >= 0) has[attribute] = true;
  }
  if (!has[ply_x] || !has[ply_y] || !has[ply_z])
    throw InputError({file}, "the vertices have no x, y and z", "export the model again");
  layout.has_normals = has[ply_nx] && has[ply_ny] && has[ply_nz];
  layout.has_uv = has[ply_s] && has[ply_t];
}

std::size_t corner_property(const std::string& file, const PlyElement& face) {
  for (std::size_t i = 0; i < face.properties.size(); ++i) {
    const PlyProperty& p = face.properties[i];
    if (p.is_list && is_integer(p.type) && (p.name == "vertex_indices" || p.name == "vertex_index"))
      return i;
  }
  throw InputError({file}, "the faces have no list of integers 'vertex_indices'",
                   "export the model again");
}

}  // namespace

PlyLayout layout_of(const std::string& file, const PlyHeader& header) {
  PlyLayout layout;
  layout.vertex_element = find_element(header, "vertex");
  layout.face_element = find_element(header, "face");
  if (layout.vertex_element == header.elements.size())
    throw InputError({file}, "has no element 'vertex'", "export the model again");
  const PlyElement& vertex = header.elements[layout.vertex_element];
  if (vertex.count > 0xffffffffu)
    throw InputError({file}, fmt::format("declares {} vertices", vertex.count),
                     "split the model into files of fewer than 2^32 vertices");
  map_vertex(file, vertex, layout);
  if (layout.face_element < header.elements.size())
    layout.corner_property = corner_property(file, header.elements[layout.face_element]);
  return layout;
}

void allocate_vertices(const PlyLayout& layout, std::uint64_t count, Mesh& mesh) {
  mesh.positions.resize(count);
  if (layout.has_normals) mesh.normals.resize(count);
  if (layout.has_uv) mesh.uv[0].resize(count);
}

void store_vertex(const PlyLayout& layout, const PlyVertex& v, std::size_t index, Mesh& mesh) {
  mesh.positions[index] = {v[ply_x], v[ply_y], v[ply_z]};
  if (layout.has_normals) mesh.normals[index] = {v[ply_nx], v[ply_ny], v[ply_nz]};
  // Texture coordinates have their origin at the bottom; textures begin with the top row.
  if (layout.has_uv) mesh.uv[0][index] = {v[ply_s], 1 - v[ply_t]};
}

void PlyFaces::add(std::span<const std::uint32_t> corners) {
  if (corners.size() == 3) {
    indices.insert(indices.end(), corners.begin(), corners.end());
    return;
  }
  if (corners.size() < 3) {
    ++too_small;
    return;
  }
  polygon_.clear(), local_.clear();
  for (const std::uint32_t c : corners) polygon_.push_back(mesh_.positions[c]);
  triangulate(polygon_, local_);
  for (const std::uint32_t l : local_) indices.push_back(corners[l]);
}

std::string corner_message(std::int64_t corner, std::uint64_t vertex_count) {
  return fmt::format("a face names vertex {}, and there are {}, numbered from 0", corner,
                     vertex_count);
}

}  // namespace penumbra
