#include "sdf/tape_writer.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"

namespace penumbra::sdf {
namespace {

constexpr std::size_t unit = 4;  // floats

bool uses_value_slot(Op op) { return op == Op::spill || op == Op::twist || op == Op::bend; }

}  // namespace

void TapeWriter::write(Op op, const Attach& attach, std::uint32_t slot, std::uint32_t surface,
                       std::span<const float> constants, WordInfo info) {
  const std::size_t offset = tape.pool.size() / unit;
  if (offset + constants.size() / unit + 3 > offset_mask || slot > 0xffff)
    throw InputError("the distance field is too large", "use fewer nodes or repetitions");
  Header header{op,
                {},
                static_cast<std::uint16_t>(slot),
                surface,
                static_cast<float>(attach.k),
                attach.k > 0 ? static_cast<float>(0.25 / attach.k) : 0.0f};
  tape.pool.resize(tape.pool.size() + unit);
  std::memcpy(&tape.pool[offset * unit], &header, sizeof header);
  tape.pool.insert(tape.pool.end(), constants.begin(), constants.end());
  tape.pool.resize((tape.pool.size() + unit - 1) / unit * unit);
  tape.place_of_unit.resize(tape.pool.size() / unit, size());
  info.acc_begin = attach.acc_begin;
  tape.info.push_back(info);
  tape.code.push_back(word_of(static_cast<std::uint32_t>(offset), attach.join));
  if (uses_value_slot(op)) tape.value_slots = std::max(tape.value_slots, slot + 1);
  if (op >= Op::turn && op < Op::pop) tape.point_slots = std::max(tape.point_slots, slot + 1);
}

void TapeWriter::shape(Op op, const Attach& attach, std::uint32_t surface_index,
                       std::span<const float> constants, float lipschitz) {
  WordInfo info;
  info.lipschitz = lipschitz;
  // Grids give 0.85 of a distance to a mesh or more (mesh_grid.h).
  if (op == Op::mesh) info.doubt = 0.18f;
  write(op, attach, 0, surface_index, constants, info);
}

void TapeWriter::act(Op op, std::uint32_t slot, std::initializer_list<double> constants,
                     double lipschitz) {
  std::vector<float> list;
  for (const double x : constants) list.push_back(static_cast<float>(x));
  WordInfo info;
  info.lipschitz = static_cast<float>(lipschitz);
  write(op, {Join::none, 0, 0}, slot, 0, list, info);
}

void TapeWriter::begin_group(const Vec3d& center, const Vec3d& half_size, std::uint32_t acc_begin,
                             bool at_top) {
  std::vector<float> list;
  for (const Vec3d& v : {center, half_size})
    for (int i = 0; i < 3; ++i) list.push_back(static_cast<float>(v[i]));
  tape.has_groups = true;
  open_groups_.push_back(size());
  write(Op::guard, {Join::none, 0, acc_begin}, at_top ? 1 : 0, 0, list, {});
  tape.code.push_back(count_mark);
  tape.info.emplace_back();
}

void TapeWriter::end_group() {
  const std::uint32_t guard = open_groups_.back();
  open_groups_.pop_back();
  tape.info[guard].v_begin = size();
  tape.code[guard + 1] = count_mark | (size() - guard - 2);
}

std::uint32_t TapeWriter::surface(std::uint32_t object, std::uint32_t material) {
  const auto next = static_cast<std::uint32_t>(tape.surfaces.size());
  const auto [entry, is_new] = surfaces_.try_emplace({object, material}, next);
  if (is_new) tape.surfaces.push_back({object, material});
  return entry->second;
}

}  // namespace penumbra::sdf
