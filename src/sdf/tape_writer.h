// Appends words and their records to a tape. Internal to the room.
#pragma once

#include <map>
#include <utility>

#include "sdf/tape.h"

namespace penumbra::sdf {

/// How a node's value joins the accumulator, and where in the code that began.
struct Attach {
  Join join = Join::load;
  double k = 0;
  std::uint32_t acc_begin = 0;
};

class TapeWriter {
 public:
  std::uint32_t size() const { return static_cast<std::uint32_t>(tape.code.size()); }

  void write(Op op, const Attach& attach, std::uint32_t slot, std::uint32_t surface,
             std::span<const float> constants, WordInfo info);
  /// A shape.
  void shape(Op op, const Attach& attach, std::uint32_t surface, std::span<const float> constants,
             float lipschitz);
  /// Something that acts on the accumulator or the point.
  void act(Op op, std::uint32_t slot, std::initializer_list<double> constants,
           double lipschitz = 1);
  /// A group of shapes begins that are all in the box; they join by min, and something before them
  /// has. Groups nest. at_top: the shapes are candidates for the least of all.
  void begin_group(const Vec3d& center, const Vec3d& half_size, std::uint32_t acc_begin,
                   bool at_top);
  void end_group();
  std::uint32_t surface(std::uint32_t object, std::uint32_t material);

  Tape tape;

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> surfaces_;
  std::vector<std::uint32_t> open_groups_;  ///< places of their guards
};

}  // namespace penumbra::sdf
