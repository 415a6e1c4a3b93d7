#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rotation.h"
#include "scene/sdf.h"

namespace penumbra {
namespace {

constexpr double inf = INFINITY;

/// In double; empty if lo > hi somewhere.
struct Box {
  Vec3d lo{inf, inf, inf}, hi{-inf, -inf, -inf};

  static Box everything() { return {Vec3d(-inf), Vec3d(inf)}; }
  static Box about(const Vec3d& center, const Vec3d& half) {
    return {center - half, center + half};
  }
  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  bool finite() const { return is_finite(lo) && is_finite(hi); }
  void grow(const Box& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
  void cut(const Box& b) { lo = max(lo, b.lo), hi = min(hi, b.hi); }
  Vec3d corner(int i) const {
    return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z};
  }
};

Vec3d vec(std::span<const double> n) { return {n[0], n[1], n[2]}; }

// Half sizes in the plane of the profile.
Vec3d profile_half_size(const SdfTree& tree, const SdfNode& node) {
  const auto n = tree.profile_numbers(node);
  Vec3d half;
  for (std::size_t i = 0; i < n.size(); ++i) {
    double& side = i % 2 == 0 ? half.x : half.y;
    side = std::max(side, std::abs(n[i]));
  }
  if (node.profile == SdfProfile::circle) half.y = half.x;
  return half;
}

// Where f ≤ level, for level ≥ 0.
class LevelBox {
 public:
  LevelBox(const SdfTree& tree, const SdfNode& node, double level)
      : tree_(tree), node_(node), n_(tree.numbers_of(node)), level_(level) {}

  Box of_shape() const {
    switch (node_.op) {
      case SdfOp::sphere:
      case SdfOp::octahedron:
        return about(Vec3d(n_[3]));
      case SdfOp::box:
      case SdfOp::round_box:
        return about(vec(n_.subspan(3)));
      case SdfOp::ellipsoid:
        return of_ellipsoid(vec(n_.subspan(3)));
      case SdfOp::torus:
        return about({n_[3] + n_[4], n_[4], n_[3] + n_[4]});
      case SdfOp::capped_torus:
        return about({n_[4] + n_[5], n_[4] + n_[5], n_[5]});
      case SdfOp::capsule:
        return inflated({min(vec(n_), vec(n_.subspan(3))) - Vec3d(n_[6]),
                         max(vec(n_), vec(n_.subspan(3))) + Vec3d(n_[6])});
      case SdfOp::cylinder:
        return about({n_[4], n_[3], n_[4]});
      case SdfOp::capped_cone:
        return about({std::max(n_[4], n_[5]), n_[3], std::max(n_[4], n_[5])});
      case SdfOp::cone: {
        const double r = n_[4] * std::tan(n_[3] * std::numbers::pi / 180);
        return inflated({vec(n_) - Vec3d(r, n_[4], r), vec(n_) + Vec3d(r, 0, r)});
      }
      case SdfOp::hexagonal_prism:
        return about({n_[3] * 2 / std::numbers::sqrt3, n_[3], n_[4]});
      case SdfOp::link:
        return about({n_[4] + n_[5], n_[3] + n_[4] + n_[5], n_[5]});
      case SdfOp::extrusion: {
        const Vec3d half = profile_half_size(tree_, node_);
        return about({half.x, half.y, n_[3]});
      }
      case SdfOp::revolution: {
        const Vec3d half = profile_half_size(tree_, node_);
        return about({n_[3] + half.x, half.y, n_[3] + half.x});
      }
      default:
        return of_plane();
    }
  }

  Box of_transform(Box child) const {
    if (child.empty()) return {};
    switch (node_.op) {
      case SdfOp::translate:
        return {child.lo + vec(n_), child.hi + vec(n_)};
      case SdfOp::rotate:
        return rotated(child);
      case SdfOp::scale: {
        const Vec3d s = vec(n_);
        return {min(child.lo * s, child.hi * s), max(child.lo * s, child.hi * s)};
      }
      case SdfOp::mirror:
        return mirrored(child);
      case SdfOp::repeat:
        return repeated(child);
      case SdfOp::twist:
        return turned(child, 0, 2);
      case SdfOp::bend:
        return turned(child, 0, 1);
      case SdfOp::elongate:
        return {child.lo - vec(n_), child.hi + vec(n_)};
      default:
        return child;
    }
  }

 private:
  Box inflated(const Box& box) const { return {box.lo - Vec3d(level_), box.hi + Vec3d(level_)}; }
  Box about(const Vec3d& half) const { return inflated(Box::about(vec(n_), half)); }

  // f ≥ (|p / r| − 1) min r.
  Box of_ellipsoid(const Vec3d& radii) const {
    const double least = std::min({radii.x, radii.y, radii.z});
    return Box::about(vec(n_), radii * (1 + level_ / least));
  }

  Box of_plane() const {
    Box box = Box::everything();
    for (int i = 0; i < 3; ++i) {
      if (n_[i] == 1) box.hi[i] = n_[3] + level_;
      if (n_[i] == -1) box.lo[i] = -n_[3] - level_;
    }
    return box;
  }

  Box rotated(const Box& child) const {
    if (!child.finite()) return Box::everything();
    const Affine turn = rotation_deg(vec(n_));
    Box box;
    for (int i = 0; i < 8; ++i) {
      const Vec3d p = turn.point(child.corner(i));
      box.grow({p, p});
    }
    return box;
  }

  Box mirrored(Box box) const {
    for (int i = 0; i < 3; ++i) {
      if (n_[i] == 0) continue;
      if (box.hi[i] < 0) return {};
      box.lo[i] = -box.hi[i];
    }
    return box;
  }

  Box repeated(Box box) const {
    for (int i = 0; i < 3; ++i) {
      if (n_[i] == 0) continue;
      const double reach = n_[3 + i] < 0 ? inf : n_[i] * n_[3 + i];
      box.lo[i] -= reach, box.hi[i] += reach;
    }
    return box;
  }

  Box turned(Box box, int a, int b) const {
    const double reach =
        std::hypot(std::max(-box.lo[a], box.hi[a]), std::max(-box.lo[b], box.hi[b]));
    box.lo[a] = box.lo[b] = -reach;
    box.hi[a] = box.hi[b] = reach;
    return box;
  }

  const SdfTree& tree_;
  const SdfNode& node_;
  std::span<const double> n_;
  double level_;
};

// f ≤ level needs a child c ≤ the returned level.
double level_of_children(const SdfTree& tree, const SdfNode& node, double level) {
  const auto n = tree.numbers_of(node);
  switch (node.op) {
    case SdfOp::smooth_union:
      // A chain of them reaches below the least child by k/4 each time, and by k at most: once it
      // is k below, nothing blends.
      return level + n[0] * std::min(1.0, 0.25 * (node.child_count - 1));
    case SdfOp::onion:
    case SdfOp::round:
      return level + n[0];
    case SdfOp::displace:
      return level + std::abs(n[0]);
    case SdfOp::scale:
      return level / std::min({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
    default:
      return level;
  }
}

Box combine(const SdfNode& node, std::span<const Box> boxes) {
  Box box = boxes[node.first_child];
  for (std::uint32_t i = 1; i < node.child_count; ++i) {
    const Box& other = boxes[node.first_child + i];
    if (node.op == SdfOp::union_ || node.op == SdfOp::smooth_union) box.grow(other);
    if (node.op == SdfOp::intersection || node.op == SdfOp::smooth_intersection) box.cut(other);
    if (box.empty()) box = {};
  }
  return box;
}

Bounds rounded_outwards(const Box& box) {
  if (box.empty()) return {};
  Bounds bounds{Vec3(box.lo), Vec3(box.hi)};
  for (int i = 0; i < 3; ++i) {
    bounds.lo[i] = std::nextafter(bounds.lo[i], -INFINITY);
    bounds.hi[i] = std::nextafter(bounds.hi[i], INFINITY);
  }
  return bounds;
}

}  // namespace

std::vector<Bounds> bounds_of_nodes(const SdfTree& tree) {
  std::vector<double> level(tree.nodes.size(), 0.0);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const SdfNode& node = tree.nodes[i];
    for (std::uint32_t c = 0; c < node.child_count; ++c)
      level[node.first_child + c] = level_of_children(tree, node, level[i]);
  }
  std::vector<Box> boxes(tree.nodes.size());
  std::vector<Bounds> bounds(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const SdfNode& node = tree.nodes[i];
    const LevelBox at_level(tree, node, level[i]);
    boxes[i] =
        node.child_count == 0 ? at_level.of_shape() : at_level.of_transform(combine(node, boxes));
    bounds[i] = rounded_outwards(boxes[i]);
  }
  return bounds;
}

Bounds bounds_of(const SdfTree& tree) { return bounds_of_nodes(tree).front(); }

Bounds bounds_of_finite_parts(const SdfTree& tree) {
  const std::vector<Bounds> bounds = bounds_of_nodes(tree);
  Bounds all;
  std::vector<std::uint32_t> parts{0};
  while (!parts.empty()) {
    const std::uint32_t i = parts.back();
    parts.pop_back();
    const SdfNode& node = tree.nodes[i];
    if (bounds[i].empty()) continue;
    if (is_finite(bounds[i]))
      all.grow(bounds[i]);
    else if (node.op == SdfOp::union_ || node.op == SdfOp::smooth_union)
      for (std::uint32_t c = 0; c < node.child_count; ++c) parts.push_back(node.first_child + c);
  }
  return all;
}

}  // namespace penumbra
