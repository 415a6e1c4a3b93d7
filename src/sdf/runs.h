// Long chains of shapes that join one accumulator by min or smooth min, with what it takes to leave
// out the far ones for a packet of points. Internal to the room.
#pragma once

#include <cstdint>
#include <vector>

namespace penumbra::sdf {

struct Tape;

/// Words [begin, begin + count) of the whole code, in clusters of neighbours that each have a box.
/// A shape whose value is at least k above the accumulator leaves it as it is, bit for bit.
struct Run {
  static constexpr std::uint32_t least_count = 32;

  std::uint32_t begin = 0, count = 0;
  float k = 0;  ///< the greatest of the words'
  std::uint32_t clusters = 0;
  std::vector<float> boxes;  ///< centre and half size by cluster; endless for shapes without
  std::vector<std::uint32_t> first_member;  ///< by cluster, and the end
  std::vector<std::uint32_t> members;       ///< places in the run
  std::vector<std::uint16_t> cluster_of;    ///< by place in the run

  std::size_t memory_bytes() const {
    return boxes.capacity() * 4 + first_member.capacity() * 4 + members.capacity() * 4 +
           cluster_of.capacity() * 2;
  }
};

/// The runs of a tape that is complete otherwise, in the order of its code.
std::vector<Run> find_runs(const Tape& tape);

}  // namespace penumbra::sdf
