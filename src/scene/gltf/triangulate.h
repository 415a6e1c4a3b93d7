// Triangle lists from strips and fans, and the vertices they use.
#pragma once

#include <cstdint>
#include <vector>

namespace penumbra::gltf {

/// The vertices of a primitive of triangles (mode 4), a strip (5) or a fan (6), as a list of three
/// a triangle (glTF 2.0, section 3.7.2.1). What is left over beyond the last whole triangle is
/// dropped.
std::vector<std::uint32_t> triangle_list(std::vector<std::uint32_t> vertices, int mode);

/// Renumbers `indices` so that they count only the vertices that occur, in increasing order, and
/// returns those. Costs no more than the indices do, however many vertices there are.
std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& indices);

}  // namespace penumbra::gltf
