// A field as straight code for an accumulator machine. Internal to the room.
//
// Registers: a point, an accumulator, numbered slots for saved points and saved accumulators. A
// word names a record in the pool and how its result joins the accumulator. A shape's record gives
// a value at the point; other records change the point or the accumulator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/vec.h"
#include "sdf/runs.h"

namespace penumbra::sdf {

enum class Op : std::uint8_t {
  sphere,
  box,
  round_box,
  ellipsoid,
  torus,
  capped_torus,
  capsule,
  cylinder,
  capped_cone,
  cone,
  plane,
  hexagonal_prism,
  octahedron,
  link,
  extrude_circle,
  extrude_box,
  extrude_polygon,
  revolve_circle,
  revolve_box,
  revolve_polygon,
  flat_polygon,
  mesh,
  guard,  ///< skips a group of shapes whose box is farther than the accumulator everywhere
  // The accumulator alone.
  spill,    ///< slot = acc
  restore,  ///< value = acc, acc = slot: then they join
  multiply,
  onion,
  round,
  displace,
  unbend,  ///< ends bend and twist
  // The point: each saves it to its slot first.
  turn,
  stretch,
  fold,
  nearest_copy,
  twist,
  bend,
  elongate,
  pop,  ///< the point back from its slot
};
inline bool is_shape(Op op) { return op < Op::guard; }

/// How a value v joins the accumulator a.
enum class Join : std::uint8_t {
  load,
  load_negative,
  min,
  max,
  max_negative,
  smin,
  smax,
  smax_negative,
  none
};

/// Record offset in the pool in units of four floats (24 bits), Join (8 bits).
using Word = std::uint32_t;
inline constexpr Word offset_mask = 0xffffff;
inline Word word_of(std::uint32_t offset, Join join) {
  return offset | static_cast<Word>(join) << 24;
}
inline Join join_of(Word w) { return static_cast<Join>(w >> 24); }

/// After a guard: how many words of the code it may skip.
inline constexpr Word count_mark = 0xff000000;
inline bool is_count(Word w) { return (w & count_mark) == count_mark; }

/// The first four floats of a record; its constants follow.
struct Header {
  Op op;
  std::uint8_t unused[1];
  std::uint16_t slot;     ///< guard: 1 if what it skips joins the result itself
  std::uint32_t surface;  ///< shapes: into Tape::surfaces; mesh: see Tape::meshes
  float k, quarter_over_k;
};
static_assert(sizeof(Header) == 16);

/// What only pruning needs to know of a word, by its place in the full code.
struct WordInfo {
  std::uint32_t acc_begin = 0;  ///< the code from there to the word made the accumulator
  std::uint32_t v_begin = 0;    ///< restore: its spill; guard: the end of its group
  float lipschitz = 1;          ///< shapes: of the value along the world's metres
  float doubt = 0;              ///< shapes: part of the value that may be missing from the distance
};

struct Surface {
  std::uint32_t object = 0, material = 0;
  friend bool operator==(const Surface&, const Surface&) = default;
};

class MeshDistance;

struct Tape {
  std::vector<float> pool;  ///< records, each from a multiple of four floats on
  std::vector<Word> code;
  std::vector<WordInfo> info;                ///< by place in the code
  std::vector<std::uint32_t> place_of_unit;  ///< offset → place
  std::vector<Surface> surfaces;
  std::vector<std::shared_ptr<const MeshDistance>> meshes;
  bool has_groups = false;  ///< there are guards
  std::vector<Run> runs;    ///< of the whole code
  std::uint32_t value_slots = 0, point_slots = 0;
  std::vector<std::string> warnings;

  const float* record(Word w) const { return pool.data() + 4 * std::size_t{w & offset_mask}; }
  const Header& header(Word w) const { return *reinterpret_cast<const Header*>(record(w)); }
  std::uint32_t place(Word w) const { return place_of_unit[w & offset_mask]; }
  std::size_t memory_bytes() const {
    std::size_t bytes = pool.capacity() * 4 + code.capacity() * 4 +
                        info.capacity() * sizeof(WordInfo) + place_of_unit.capacity() * 4 +
                        surfaces.capacity() * sizeof(Surface);
    for (const Run& run : runs) bytes += run.memory_bytes();
    return bytes;
  }
};

}  // namespace penumbra::sdf
