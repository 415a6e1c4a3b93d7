// What the statements of an OBJ file say, before it becomes meshes
// (Wavefront 1995, Advanced Visualizer Manual, appendix B1: Object Files).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"

namespace penumbra {

/// Numbers of a corner's position, texture coordinates and normal, from 0; none where absent. They
/// are in range: read_obj_statements checks it.
using ObjCorner = std::array<std::uint32_t, 3>;
constexpr std::uint32_t kNoAttribute = 0xffffffffu;

struct ObjFace {
  std::size_t first_corner = 0;
  std::uint32_t corner_count = 0;  ///< at least 3
  std::uint32_t group = 0;         ///< into ObjStatements::groups
};

/// Faces of one object and one material.
struct ObjGroup {
  std::uint32_t object = 0;    ///< into ObjStatements::objects
  std::uint32_t material = 0;  ///< into ObjStatements::materials
};

struct ObjStatements {
  std::vector<Vec3> positions, normals;
  std::vector<Vec2> texcoords;  ///< v up, as in the file
  std::vector<ObjCorner> corners;
  std::vector<ObjFace> faces;
  std::vector<ObjGroup> groups;
  std::vector<std::string> objects;    ///< names; empty before the first `o` or `g`
  std::vector<std::string> materials;  ///< names that `usemtl` gives; empty before the first
  std::vector<std::string> libraries;  ///< the rest of each `mtllib` line
  std::vector<std::string> warnings;
};

/// Throws InputError with line and column for numbers that are none, a face of fewer than three
/// corners or one that names a vertex that the file does not have (before or after it).
ObjStatements read_obj_statements(const std::string& file, std::string_view text);

}  // namespace penumbra
