#include "sdf/lipschitz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/sdf_path.h"

namespace penumbra::sdf {
namespace {

/// Beyond this many radii of its child a twist or bend stops turning.
constexpr double reach_factor = 1.5;
/// Where the child has no radius: rate · radius is taken to be this.
constexpr double unknown_shear = 2;
constexpr int most_warnings = 5;  // of one object

// Outside, the gradient of the ellipsoid's bound is u + (1 − s)(u − W) for a unit vector u and s in
// [0, 1], W = (Σ u² r²) R⁻² u: steepest at infinity, s = 0. Searched over the directions.
float ellipsoid_constant(std::span<const double> r) {
  constexpr int steps = 96;
  double most = 1;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const double w[3] = {double(i) / steps, double(j) / steps, double(steps - i - j) / steps};
      double a = 0, b = 0, c = 0;
      for (int k = 0; k < 3; ++k) {
        const double square = r[k] * r[k];
        a += w[k] * square, b += w[k] / square, c += w[k] / (square * square);
      }
      most = std::max(most, 4 - 4 * a * b + a * a * c);
    }
  return most > 1 ? static_cast<float>(1.01 * std::sqrt(most)) : 1.0f;
}

double reach_of(const Bounds& box, int a, int b) {
  if (box.empty()) return 0;
  const double x = std::max(-box.lo[a], box.hi[a]), y = std::max(-box.lo[b], box.hi[b]);
  return reach_factor * std::hypot(std::max(x, 0.0), std::max(y, 0.0));
}

// The most that turning by `shear` = rate · radius stretches: I + shear a bᵀ with unit a and b,
// which are perpendicular in a twist.
double stretch_of(SdfOp op, double shear) {
  return op == SdfOp::twist ? shear / 2 + std::sqrt(1 + shear * shear / 4) : 1 + shear;
}

class Slopes {
 public:
  Slopes(const SdfTree& tree, const std::string& object, std::vector<std::string>& warnings)
      : tree_(tree), object_(object), warnings_(warnings), bounds_(bounds_of_nodes(tree)) {}

  std::vector<NodeSlope> run() {
    slopes_.resize(tree_.nodes.size());
    for (std::size_t i = tree_.nodes.size(); i-- > 0;)
      slopes_[i] = slope_of(static_cast<std::uint32_t>(i));
    return std::move(slopes_);
  }

 private:
  float steepest_child(const SdfNode& node) const {
    float most = 1;
    for (std::uint32_t c = 0; c < node.child_count; ++c)
      most = std::max(most, slopes_[node.first_child + c].constant);
    return most;
  }

  NodeSlope slope_of(std::uint32_t index) {
    const SdfNode& node = tree_.nodes[index];
    const auto n = tree_.numbers_of(node);
    if (node.op == SdfOp::ellipsoid) return {ellipsoid_constant(n.subspan(3)), 0};
    if (node.child_count == 0 || divides_children(node.op)) return {};
    const float child = steepest_child(node);
    if (node.op == SdfOp::displace) {
      const double f = std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
      return {static_cast<float>(child + std::abs(n[0]) * f), 0};
    }
    if (node.op == SdfOp::twist || node.op == SdfOp::bend) return turned(index, child, n[0]);
    return {child, 0};
  }

  NodeSlope turned(std::uint32_t index, float child, double rate) {
    const SdfNode& node = tree_.nodes[index];
    const Bounds& box = bounds_[node.first_child];
    const double reach = reach_of(box, 0, node.op == SdfOp::twist ? 2 : 1);
    if (std::isfinite(reach))
      return {static_cast<float>(child * stretch_of(node.op, std::abs(rate) * reach)),
              static_cast<float>(reach)};
    warn(index);
    return {static_cast<float>(child * stretch_of(node.op, unknown_shear)), INFINITY};
  }

  void warn(std::uint32_t index) {
    if (++warned_ > most_warnings) {
      if (warned_ == most_warnings + 1)
        warnings_.push_back(fmt::format("\"{}\" has more of these", object_));
      return;
    }
    warnings_.push_back(fmt::format(
        "the {} at {} of \"{}\" turns something unbounded: no safe step is known, far from its "
        "axis rays may pass through",
        signature_of(tree_.nodes[index].op).name, sdf_path(tree_, index), object_));
  }

  const SdfTree& tree_;
  const std::string& object_;
  std::vector<std::string>& warnings_;
  std::vector<Bounds> bounds_;
  std::vector<NodeSlope> slopes_;
  int warned_ = 0;
};

// Does the shape mirror into itself at the plane where the axis is 0?
bool is_symmetric(const SdfTree& tree, const SdfNode& node, int axis) {
  const auto n = tree.numbers_of(node);
  switch (node.op) {
    case SdfOp::capsule:
      return n[axis] == 0 && n[3 + axis] == 0;
    case SdfOp::plane:
      return n[axis] == 0;
    case SdfOp::cone:
    case SdfOp::capped_cone:
    case SdfOp::capped_torus:
      return n[axis] == 0 && axis != 1;
    case SdfOp::extrusion:
      return n[axis] == 0 && (axis == 2 || node.profile != SdfProfile::polygon);
    case SdfOp::revolution:
      return n[axis] == 0 && (axis != 1 || node.profile != SdfProfile::polygon);
    default:
      return node.child_count == 0 && n[axis] == 0;
  }
}

}  // namespace

bool divides_children(SdfOp op) {
  return op == SdfOp::union_ || op == SdfOp::intersection || op == SdfOp::difference;
}

std::vector<NodeSlope> slopes_of(const SdfTree& tree, const std::string& object,
                                 std::vector<std::string>& warnings) {
  return Slopes(tree, object, warnings).run();
}

CopyCounts copies_of(const SdfTree& tree, const SdfNode& repeat,
                     const std::vector<Bounds>& bounds) {
  const auto n = tree.numbers_of(repeat);
  const SdfNode& child = tree.nodes[repeat.first_child];
  const Bounds& box = bounds[repeat.first_child];
  CopyCounts counts{};
  for (int axis = 0; axis < 3; ++axis) {
    if (n[axis] == 0) continue;
    const double half = n[axis] / 2;
    const bool fits = -box.lo[axis] <= half && box.hi[axis] <= half;
    counts.along[axis] = fits && is_symmetric(tree, child, axis) ? 1 : 2;
  }
  return counts;
}

}  // namespace penumbra::sdf
