// What of a PLY file's elements becomes a mesh, whatever its encoding.
#pragma once

#include <array>
#include <span>

#include "scene/mesh/ply_header.h"
#include "scene/scene.h"

namespace penumbra {

/// The attributes of a vertex that are read, in the order of PlyVertex.
enum PlyAttribute { ply_x, ply_y, ply_z, ply_nx, ply_ny, ply_nz, ply_s, ply_t, ply_attributes };
using PlyVertex = std::array<float, ply_attributes>;

struct PlyLayout {
  std::size_t vertex_element = 0;
  std::size_t face_element = 0;     ///< = the number of elements if there are no faces
  std::vector<int> attribute;       ///< per property of a vertex: which attribute; −1 = skipped
  std::size_t corner_property = 0;  ///< of a face: the list of vertex numbers
  bool has_normals = false, has_uv = false;
};

/// Throws InputError if there are no vertices with x, y and z, or the faces list no vertices.
PlyLayout layout_of(const std::string& file, const PlyHeader& header);

/// Makes room for the vertices, whose number has been checked against the size of the file.
void allocate_vertices(const PlyLayout& layout, std::uint64_t count, Mesh& mesh);
/// Writes one; different vertices may be written by different threads.
void store_vertex(const PlyLayout& layout, const PlyVertex& vertex, std::size_t index, Mesh& mesh);

/// Appends the triangles of one face; corners must be in range. Scratch memory is kept between
/// calls.
class PlyFaces {
 public:
  explicit PlyFaces(const Mesh& mesh) : mesh_(mesh) {}
  void add(std::span<const std::uint32_t> corners);

  std::vector<std::uint32_t> indices;
  std::uint64_t too_small = 0;  ///< faces of fewer than three corners

 private:
  const Mesh& mesh_;
  std::vector<Vec3> polygon_;
  std::vector<std::uint32_t> local_;
};

/// "a face names vertex 9, and there are 8, numbered from 0".
std::string corner_message(std::int64_t corner, std::uint64_t vertex_count);

/// The bodies in their encodings: `contents` is the whole file. Give the mesh's vertices and
/// triangles; return the number of faces left out for having fewer than three corners.
std::uint64_t read_ply_ascii(const std::string& file, std::string_view contents,
                             const PlyHeader& header, const PlyLayout& layout, Mesh& mesh);
std::uint64_t read_ply_binary(const std::string& file, std::string_view contents,
                              const PlyHeader& header, const PlyLayout& layout, Mesh& mesh);

}  // namespace penumbra
