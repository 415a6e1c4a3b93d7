#include "sdf/runs.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sdf/tape.h"

namespace penumbra::sdf {
namespace {

constexpr std::size_t cluster_size = 16;
constexpr std::size_t most_clusters = 0xffff;

Bounds around(const float* c, const Vec3& half) {
  const Vec3 center(c[0], c[1], c[2]);
  return {center - half, center + half};
}

/// A box that the shape's value is nowhere less far from than it says, in the point's frame. Only
/// of shapes whose values are distances.
std::optional<Bounds> box_of(Op op, const float* c) {
  switch (op) {
    case Op::sphere:
    case Op::octahedron:
      return around(c, Vec3(c[3]));
    case Op::box:
      return around(c, {c[3], c[4], c[5]});
    case Op::round_box:
      return around(c, Vec3(c[3], c[4], c[5]) + Vec3(c[6]));
    case Op::torus:
      return around(c, {c[3] + c[4], c[4], c[3] + c[4]});
    case Op::capsule: {
      Bounds box = around(c, Vec3(c[7]));
      const Vec3 along(c[3], c[4], c[5]);
      box.grow(box.lo + along), box.grow(box.hi + along);
      return box;
    }
    case Op::cylinder:
      return around(c, {c[4], c[3], c[4]});
    case Op::capped_cone:
      return around(c, {std::max(c[4], c[5]), c[3], std::max(c[4], c[5])});
    case Op::link:
      return around(c, {c[4] + c[5], c[3] + c[4] + c[5], c[5]});
    default:
      return {};
  }
}

std::uint64_t spread(std::uint64_t x) {
  std::uint64_t out = 0;
  for (int bit = 0; bit < 10; ++bit) out |= (x >> bit & 1) << (3 * bit);
  return out;
}

class RunBuilder {
 public:
  RunBuilder(const Tape& tape, std::uint32_t begin, std::uint32_t count) {
    run_.begin = begin, run_.count = count;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Word w = tape.code[begin + i];
      const Header& header = tape.header(w);
      if (join_of(w) == Join::smin) run_.k = std::max(run_.k, header.k);
      boxes_.push_back(box_of(header.op, tape.record(w) + 4));
    }
  }

  Run build() {
    sort_members();
    const std::size_t clusters = lists_.size();
    run_.clusters = static_cast<std::uint32_t>(clusters);
    run_.cluster_of.resize(run_.count);
    for (std::size_t c = 0; c < clusters; ++c) {
      run_.first_member.push_back(static_cast<std::uint32_t>(run_.members.size()));
      Bounds box;
      bool has_box = true;
      for (const std::uint32_t i : lists_[c]) {
        run_.members.push_back(i);
        run_.cluster_of[i] = static_cast<std::uint16_t>(c);
        if (boxes_[i])
          box.grow(*boxes_[i]);
        else
          has_box = false;
      }
      add_box(has_box ? box.center() : Vec3(), has_box ? box.size() * 0.5f : Vec3(INFINITY));
    }
    run_.first_member.push_back(run_.count);
    return std::move(run_);
  }

 private:
  void add_box(const Vec3& center, const Vec3& half) {
    for (const Vec3& v : {center, half}) run_.boxes.insert(run_.boxes.end(), {v.x, v.y, v.z});
  }

  // Clusters: first those without a box, then neighbours along the Morton curve.
  void sort_members() {
    std::vector<std::uint32_t> with_box, others;
    Bounds all;
    for (std::uint32_t i = 0; i < run_.count; ++i) {
      (boxes_[i] ? with_box : others).push_back(i);
      if (boxes_[i]) all.grow(boxes_[i]->center());
    }
    std::vector<std::uint64_t> code(run_.count);
    const float size = std::max(all.empty() ? 0.0f : max_component(all.size()), 1e-30f);
    for (const std::uint32_t i : with_box) {
      const Vec3 at = (boxes_[i]->center() - all.lo) * (1023 / size);
      for (int axis = 0; axis < 3; ++axis)
        code[i] |= spread(static_cast<std::uint64_t>(at[axis])) << axis;
    }
    std::ranges::stable_sort(with_box, {}, [&](std::uint32_t i) { return code[i]; });
    if (!others.empty()) lists_.push_back(std::move(others));
    const std::size_t each = std::max(cluster_size, with_box.size() / (most_clusters - 1) + 1);
    for (std::size_t i = 0; i < with_box.size(); i += each)
      lists_.emplace_back(
          with_box.begin() + static_cast<std::ptrdiff_t>(i),
          with_box.begin() + static_cast<std::ptrdiff_t>(std::min(i + each, with_box.size())));
  }

  Run run_;
  std::vector<std::optional<Bounds>> boxes_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

bool can_run(const Tape& tape, Word w) {
  if (is_count(w)) return false;
  const Header& header = tape.header(w);
  const Join join = join_of(w);
  return is_shape(header.op) && (join == Join::smin || join == Join::min);
}

}  // namespace

std::vector<Run> find_runs(const Tape& tape) {
  std::vector<Run> runs;
  const auto size = static_cast<std::uint32_t>(tape.code.size());
  for (std::uint32_t begin = 0; begin < size;) {
    std::uint32_t end = begin;
    bool smooth = false;
    // A guard and its count come before what it guards: such words are skipped together already.
    while (end < size && can_run(tape, tape.code[end])) {
      smooth = smooth || join_of(tape.code[end]) == Join::smin;
      ++end;
    }
    const bool guarded = begin > 0 && is_count(tape.code[begin - 1]);
    if (smooth && !guarded && end - begin >= Run::least_count)
      runs.push_back(RunBuilder(tape, begin, end - begin).build());
    begin = std::max(end, begin + 1);
  }
  return runs;
}

}  // namespace penumbra::sdf
