#include "sdf/compile_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/rotation.h"
#include "sdf/leaves.h"
#include "sdf/lipschitz.h"

namespace penumbra::sdf {
namespace {

/// Copies of one shape that nested repetitions may ask for; beyond, only the nearest counts.
constexpr int most_copies = 64;

Vec3d vec(std::span<const double> n) { return {n[0], n[1], n[2]}; }

Join join_of(SdfOp op) {
  switch (op) {
    case SdfOp::intersection:
      return Join::max;
    case SdfOp::difference:
      return Join::max_negative;
    case SdfOp::smooth_union:
      return Join::smin;
    case SdfOp::smooth_intersection:
      return Join::smax;
    case SdfOp::smooth_difference:
      return Join::smax_negative;
    default:
      return Join::min;
  }
}

// k = 0 is the hard operator.
Join hard_unless(Join smooth, double k) {
  if (k > 0 || smooth < Join::smin) return smooth;
  return smooth == Join::smin ? Join::min : smooth == Join::smax ? Join::max : Join::max_negative;
}

/// What holds on the way from the root to a node.
struct Context {
  Placement at;
  double stretch = 1;  ///< world metres to the node's value: what every shape's slope is times
  std::uint32_t value_slot = 0, point_slot = 0;
  int copies = 1;
  bool at_top = true;  ///< the node's value is a candidate for the least of all, as it is
};

/// A node to write, or a record that is due once the node before it is written.
struct Task {
  enum Kind : std::uint8_t {
    visit,
    divided_visit,
    copy,
    group,
    group_end,
    act,
    restore
  } kind = visit;
  std::uint32_t node = 0;
  Context context{};
  Attach attach{};
  Op op = Op::pop;
  std::uint32_t slot = 0;
  std::array<double, 8> constants{};
  double lipschitz = 1;
  std::uint32_t v_begin = 0;
};

class TreeWriter {
 public:
  TreeWriter(TapeWriter& writer, const SdfTree& tree, const std::string& object)
      : out_(writer),
        tree_(tree),
        object_(object),
        bounds_(bounds_of_nodes(tree)),
        slopes_(slopes_of(tree, object, writer.tape.warnings)) {}

  void write(const Attach& attach) {
    push_child(0, {}, attach, true);
    while (!tasks_.empty()) {
      const Task task = tasks_.back();
      tasks_.pop_back();
      run(task);
    }
  }

 private:
  void run(const Task& task) {
    switch (task.kind) {
      case Task::visit:
        return visit(task.node, task.context, task.attach);
      case Task::divided_visit:
        return visit_divided(task);
      case Task::copy:
        return visit_copy(task);
      case Task::group: {
        const auto& c = task.constants;
        return out_.begin_group({c[0], c[1], c[2]}, {c[3], c[4], c[5]}, task.attach.acc_begin,
                                c[6] != 0);
      }
      case Task::group_end:
        return out_.end_group();
      case Task::act: {
        const auto& c = task.constants;
        return out_.act(task.op, task.slot, {c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]},
                        task.lipschitz);
      }
      case Task::restore:
        WordInfo info;
        info.v_begin = task.v_begin;
        return out_.write(Op::restore, task.attach, task.slot, 0, {}, info);
    }
  }

  // The tasks are a stack: what is pushed last runs first.
  void push_child(std::uint32_t node, const Context& context, const Attach& attach, bool divided) {
    Task task;
    task.kind = divided && slopes_[node].constant > 1 ? Task::divided_visit : Task::visit;
    task.node = node;
    task.context = context;
    task.attach = attach;
    tasks_.push_back(task);
  }

  void push_act(Op op, std::uint32_t slot, std::array<double, 8> constants = {},
                double lipschitz = 1) {
    Task task;
    task.kind = Task::act;
    task.op = op;
    task.slot = slot;
    task.constants = constants;
    task.lipschitz = lipschitz;
    tasks_.push_back(task);
  }

  // From here on the node has an accumulator of its own, which joins the outer one at its end.
  Context own_accumulator(Context context, const Attach& attach) {
    if (attach.join == Join::load) return context;
    Task task;
    task.kind = Task::restore;
    task.attach = attach;
    task.slot = context.value_slot;
    task.v_begin = out_.size();
    tasks_.push_back(task);
    out_.act(Op::spill, context.value_slot++, {});
    context.at_top = context.at_top && attach.join == Join::min;
    return context;
  }

  // Turns the point so that the node's axes are the point's, and back after the node.
  Context turned(Context context) {
    if (!context.at.is_turned()) return context;
    const Affine& m = context.at.turn;
    const Vec3d& t = context.at.offset;
    push_act(Op::pop, context.point_slot);
    out_.act(Op::turn, context.point_slot++,
             {t.x, t.y, t.z, m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z});
    context.at = context.at.reset();
    return context;
  }

  void visit_divided(const Task& task) {
    Context inner = own_accumulator(task.context, task.attach);
    inner.at_top = false;
    push_act(Op::multiply, 0, {1.0 / slopes_[task.node].constant});
    push_child(task.node, inner, {}, false);
  }

  void visit(std::uint32_t index, const Context& context, const Attach& attach) {
    const SdfNode& node = tree_.nodes[index];
    const auto n = tree_.numbers_of(node);
    switch (signature_of(node.op).kind) {
      case SdfKind::shape:
        return shape(node, context, attach);
      case SdfKind::operation:
        if (signature_of(node.op).most_children == 1) return unary(node, context, attach);
        return several(node, context, attach);
      case SdfKind::transform:
        break;
    }
    Context inner = context;
    Placement& at = inner.at;
    if (node.op == SdfOp::translate)
      at.offset = context.at.point(vec(n));
    else if (node.op == SdfOp::rotate)
      at.turn = at.turn * rotation_deg(vec(n));
    else if (node.op == SdfOp::scale && n[0] == n[1] && n[1] == n[2])
      scale_evenly(at, n[0]);
    else
      return transform(index, context, attach);
    push_child(node.first_child, inner, attach, false);
  }

  static void scale_evenly(Placement& at, double factor) {
    at.scale *= std::abs(factor);
    if (factor < 0) at.turn = at.turn * Affine{{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {}};
  }

  void shape(const SdfNode& node, Context context, const Attach& attach) {
    const std::uint32_t surface = out_.surface(tree_.object, node.material);
    const auto lipschitz = static_cast<float>(
        context.stretch * slopes_[static_cast<std::size_t>(&node - tree_.nodes.data())].constant);
    if (!context.at.is_turned() || takes_turn(node.op)) {
      const Leaf leaf = leaf_of(tree_, node, context.at);
      return out_.shape(leaf.op, attach, surface, leaf.constants, lipschitz);
    }
    context = own_accumulator(context, attach);
    context = turned(context);
    const Leaf leaf = leaf_of(tree_, node, context.at);
    out_.shape(leaf.op, {}, surface, leaf.constants, lipschitz);
  }

  void several(const SdfNode& node, Context context, const Attach& attach) {
    const bool divided = divides_children(node.op);
    if (node.child_count == 1) return push_child(node.first_child, context, attach, divided);
    const bool joins_outer =
        node.op == SdfOp::union_ && attach.join == Join::min && !context.at.is_turned();
    Attach first = attach;
    if (!joins_outer) {
      context = own_accumulator(context, attach);
      context = turned(context);
      first = {};
    }
    context.at_top = context.at_top && node.op == SdfOp::union_;
    const double k = node.number_count > 0 ? tree_.numbers_of(node)[0] * context.at.scale : 0;
    const Attach rest{hard_unless(join_of(node.op), k), k,
                      joins_outer ? attach.acc_begin : out_.size()};
    std::vector<std::uint32_t> order(node.child_count);
    std::iota(order.begin(), order.end(), node.first_child);
    std::size_t grouped = order.size();
    if (node.op == SdfOp::union_ && order.size() >= least_grouped && !context.at.is_turned())
      grouped = std::max<std::size_t>(sort_by_place(order), 1);
    push_groups({order.begin() + static_cast<std::ptrdiff_t>(grouped), order.end()}, context, rest);
    for (std::size_t c = grouped; c-- > 1;) push_child(order[c], context, rest, divided);
    push_child(order.front(), context, first, divided);
  }

  /// A union of fewer is not grouped.
  static constexpr std::size_t least_grouped = 16;

  // Is the field no less than the distance from the bounds? So it is for exact shapes.
  bool is_exact_shape(std::uint32_t i) const {
    const SdfOp op = tree_.nodes[i].op;
    return signature_of(op).kind == SdfKind::shape && op != SdfOp::ellipsoid &&
           is_finite(bounds_[i]);
  }

  // What can be grouped goes to the end, neighbours together (along the Morton curve); gives where
  // that begins. min takes any order.
  std::size_t sort_by_place(std::vector<std::uint32_t>& order) const {
    const auto first = std::stable_partition(order.begin(), order.end(),
                                             [&](auto i) { return !is_exact_shape(i); });
    Bounds all;
    for (auto i = first; i != order.end(); ++i) all.grow(bounds_[*i].center());
    const Vec3 size = max(all.size(), Vec3(1e-30f));
    const auto code = [&](std::uint32_t i) {
      const Vec3 at = bounds_[i].center() - all.lo;
      std::uint64_t morton = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::uint64_t>(1023 * at[axis] / max_component(size));
        for (int bit = 0; bit < 10; ++bit) morton |= (cell >> bit & 1) << (3 * bit + axis);
      }
      return morton;
    };
    std::stable_sort(first, order.end(), [&](auto a, auto b) { return code(a) < code(b); });
    return static_cast<std::size_t>(first - order.begin());
  }

  // Groups of 8, 64 and 512 shapes, each under its guard.
  void push_groups(std::vector<std::uint32_t> nodes, const Context& context, const Attach& attach) {
    for (std::size_t i = nodes.size(); i-- > 0;) {
      for (const std::size_t group : {512, 64, 8})
        if ((i + 1) % group == 0 || i + 1 == nodes.size()) push_group_end();
      push_child(nodes[i], context, attach, true);
      for (const std::size_t group : {8, 64, 512})
        if (i % group == 0)
          push_group(std::span(nodes).subspan(i, std::min(group, nodes.size() - i)), context,
                     attach);
    }
  }

  void push_group_end() { tasks_.emplace_back().kind = Task::group_end; }

  void push_group(std::span<const std::uint32_t> nodes, const Context& context,
                  const Attach& attach) {
    Bounds box;
    for (const std::uint32_t i : nodes) box.grow(bounds_[i]);
    const Vec3d center = context.at.point(Vec3d(box.center()));
    // With room for rounding, here and in the shapes' own values.
    const Vec3d half = Vec3d(box.size()) * (0.5 * context.at.scale) * 1.0001 +
                       Vec3d(1e-5 * max_component(abs(center)));
    Task task;
    task.kind = Task::group;
    task.attach = attach;
    task.constants = {center.x, center.y, center.z, half.x, half.y, half.z, double(context.at_top)};
    tasks_.push_back(task);
  }

  void unary(const SdfNode& node, Context context, const Attach& attach) {
    const auto n = tree_.numbers_of(node);
    context = own_accumulator(context, attach);
    context.at_top = false;
    const double s = context.at.scale;
    if (node.op == SdfOp::displace) {
      context = turned(context);
      const Vec3d& t = context.at.offset;
      const double steepest = std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
      push_act(Op::displace, 0, {t.x, t.y, t.z, n[0] * s, n[1] / s, n[2] / s, n[3] / s},
               std::abs(n[0]) * steepest * context.stretch);
    } else {
      push_act(node.op == SdfOp::onion ? Op::onion : Op::round, 0, {n[0] * s});
    }
    push_child(node.first_child, context, {}, false);
  }

  void transform(std::uint32_t index, Context context, const Attach& attach) {
    const SdfNode& node = tree_.nodes[index];
    context = own_accumulator(context, attach);
    context = turned(context);
    switch (node.op) {
      case SdfOp::scale:
        return stretch(node, context);
      case SdfOp::repeat:
        return repeat(node, context);
      case SdfOp::twist:
      case SdfOp::bend:
        return bend(index, context);
      default:
        return fold(node, context);
    }
  }

  Context inside(const Context& context) const {
    Context inner = context;
    inner.at = context.at.reset();
    inner.at_top = false;
    ++inner.point_slot;
    return inner;
  }

  void stretch(const SdfNode& node, const Context& context) {
    const Vec3d f = vec(tree_.numbers_of(node)), &t = context.at.offset;
    const double least = std::min({std::abs(f.x), std::abs(f.y), std::abs(f.z)});
    out_.act(Op::stretch, context.point_slot, {t.x, t.y, t.z, 1 / f.x, 1 / f.y, 1 / f.z});
    push_act(Op::pop, context.point_slot);
    push_act(Op::multiply, 0, {least});
    Context inner = inside(context);
    inner.stretch /= least;
    push_child(node.first_child, inner, {}, false);
  }

  void fold(const SdfNode& node, const Context& context) {
    const auto n = tree_.numbers_of(node);
    const Vec3d& t = context.at.offset;
    const bool is_mirror = node.op == SdfOp::mirror;
    const Vec3d v = is_mirror ? vec(n) : vec(n) * context.at.scale;
    out_.act(is_mirror ? Op::fold : Op::elongate, context.point_slot,
             {t.x, t.y, t.z, v.x, v.y, v.z});
    push_act(Op::pop, context.point_slot);
    push_child(node.first_child, inside(context), {}, false);
  }

  void bend(std::uint32_t index, const Context& context) {
    const SdfNode& node = tree_.nodes[index];
    const double s = context.at.scale, rate = tree_.numbers_of(node)[0];
    const double reach = std::min(double{slopes_[index].reach} * s, 1e30);
    const Vec3d& t = context.at.offset;
    out_.act(node.op == SdfOp::twist ? Op::twist : Op::bend, context.value_slot,
             {t.x, t.y, t.z, rate / s, reach, double(context.point_slot)});
    out_.tape.point_slots = std::max(out_.tape.point_slots, context.point_slot + 1);
    Context inner = inside(context);
    ++inner.value_slot;
    inner.stretch *= slopes_[index].constant / slopes_[node.first_child].constant;
    push_act(Op::unbend, context.value_slot, {double(context.point_slot)}, context.stretch);
    push_child(node.first_child, inner, {}, false);
  }

  void repeat(const SdfNode& node, Context context) {
    CopyCounts counts = copies_of(tree_, node, bounds_);
    bool is_exact = true;  // one copy suffices, and the field does not jump between copies
    int total = 1;
    for (const int c : counts.along) total *= std::max(c, 1);
    if (total > 1 && context.copies * total > most_copies) {
      warn_of_copies();
      is_exact = false;
      for (int& c : counts.along) c = std::min(c, 1);
      total = 1;
    }
    context.copies *= total;
    const std::uint32_t begin = out_.size();
    for (int copy = 8; copy-- > 0;) {
      Task task;
      task.kind = Task::copy;
      for (int i = 0; i < 3; ++i) task.constants[3 + i] = counts.along[i] == 1 && is_exact;
      task.node = static_cast<std::uint32_t>(&node - tree_.nodes.data());
      task.context = context;
      if (copy > 0) task.attach = {Join::min, 0, begin};
      bool wanted = true;
      for (int i = 0; i < 3; ++i) {
        const int next = copy >> i & 1;
        task.constants[i] = next;
        wanted = wanted && next < std::max(counts.along[i], 1);
      }
      if (wanted) tasks_.push_back(task);
    }
  }

  // A copy after the first has an accumulator of its own: the point is saved within it.
  void visit_copy(const Task& task) {
    const SdfNode& node = tree_.nodes[task.node];
    const Context context = own_accumulator(task.context, task.attach);
    const auto n = tree_.numbers_of(node);
    const Vec3d& t = context.at.offset;
    const Vec3d size = vec(n) * context.at.scale;
    const auto inverse = [&](int i) { return size[i] > 0 ? 1 / size[i] : 0; };
    const auto limit = [&](int i) { return n[3 + i] < 0 ? 1e30 : n[3 + i]; };
    const auto& next = task.constants;
    out_.act(Op::nearest_copy, context.point_slot,
             {t.x, t.y, t.z, size.x, size.y, size.z, inverse(0), inverse(1), inverse(2), limit(0),
              limit(1), limit(2), next[0], next[1], next[2], next[3], next[4], next[5]},
             context.stretch);
    push_act(Op::pop, context.point_slot);
    push_child(node.first_child, inside(context), {}, false);
  }

  void warn_of_copies() {
    if (std::exchange(warned_of_copies_, true)) return;
    out_.tape.warnings.push_back(fmt::format(
        "the repetitions of \"{}\" are nested too deeply: only the nearest copies count, so that "
        "rays may pass through others",
        object_));
  }

  TapeWriter& out_;
  const SdfTree& tree_;
  const std::string& object_;
  std::vector<Bounds> bounds_;
  std::vector<NodeSlope> slopes_;
  std::vector<Task> tasks_;
  bool warned_of_copies_ = false;
};

}  // namespace

void write_tree(TapeWriter& writer, const SdfTree& tree, const std::string& object,
                const Attach& attach) {
  TreeWriter(writer, tree, object).write(attach);
}

}  // namespace penumbra::sdf
