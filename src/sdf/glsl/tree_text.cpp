#include "sdf/glsl/tree_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/rotation.h"
#include "sdf/glsl/numbers.h"

namespace penumbra::sdf {
namespace {

/// As the tape: copies of one shape that nested repetitions may ask for.
constexpr int kMostCopies = 64;
constexpr int kDeepestIndent = 12;

Vec3d vec(std::span<const double> n) { return {n[0], n[1], n[2]}; }

bool is_smooth(SdfOp op) {
  return op == SdfOp::smooth_union || op == SdfOp::smooth_intersection ||
         op == SdfOp::smooth_difference;
}

// Columns are the images of the axes.
std::string matrix(const Affine& m) {
  return "mat3(" + vector(m.x) + ", " + vector(m.y) + ", " + vector(m.z) + ')';
}

std::string comment(const std::string& object) {
  std::string text = object;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\') c = ' ';
  return text;
}

}  // namespace

TreeText::TreeText(const SdfTree& tree, std::string name, const std::string& object,
                   std::vector<std::string>& warnings)
    : tree_(tree),
      name_(std::move(name)),
      object_(comment(object)),
      warnings_(warnings),
      bounds_(bounds_of_nodes(tree)),
      slopes_(slopes_of(tree, object, warnings)) {}

bool TreeText::has_one_material() const {
  const auto first = tree_.nodes.back().material;
  return std::all_of(tree_.nodes.begin(), tree_.nodes.end(), [&](const SdfNode& node) {
    return node.child_count > 0 || node.material == first;
  });
}

std::string TreeText::value_functions() {
  shade_ = false;
  return functions();
}

std::string TreeText::shade_functions() {
  shade_ = true;
  return functions();
}

std::string TreeText::part_name(std::uint32_t node) const {
  const std::string base = node == 0 ? name_ : fmt::format("{}_part{}", name_, node);
  return shade_ ? base + "_shade" : base;
}

std::string TreeText::signature(std::uint32_t node) const {
  return fmt::format("float {}(vec3 p{})", part_name(node), shade_ ? ", out pnb_Material m" : "");
}

// Parts are found while the functions that call them are written: what is found last comes first.
std::string TreeText::functions() {
  parts_ = {{0, 1}};
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    body_.clear(), outlines_.clear();
    write_part(Part(parts_[i]));
    texts.push_back(outlines_ + body_);
  }
  std::string all;
  for (auto text = texts.rbegin(); text != texts.rend(); ++text) all += '\n' + *text;
  return all;
}

void TreeText::write_part(const Part& part) {
  if (part.node == 0) body_ += "// " + object_ + '\n';
  body_ += signature(part.node) + " {\n";
  Task root;
  root.node = part.node;
  root.point = "p";
  root.copies = part.copies;
  tasks_ = {root};
  while (!tasks_.empty()) {
    const Task task = std::move(tasks_.back());
    tasks_.pop_back();
    depth_ = task.depth;
    run(task);
  }
  depth_ = 1;
  const float slope = part.node == 0 ? slopes_[0].constant : 1;
  material_line(fmt::format("m = m{};", part.node));
  line(slope > 1 ? fmt::format("return d{} / {};", part.node, number(slope))
                 : fmt::format("return d{};", part.node));
  body_ += "}\n";
}

void TreeText::line(const std::string& text) {
  body_.append(static_cast<std::size_t>(2 * std::min(depth_, kDeepestIndent)), ' ');
  body_ += text + '\n';
}

void TreeText::material_line(const std::string& text) {
  if (shade_) line(text);
}

void TreeText::run(const Task& task) {
  if (task.kind == Task::enter) return enter(task);
  if (task.kind == Task::join) return join(task);
  leave(task);
}

void TreeText::push_children(const Task& task, const std::string& point) {
  const SdfNode& node = tree_.nodes[task.node];
  Task next = task;
  next.kind = Task::leave;
  tasks_.push_back(next);
  for (std::uint32_t c = node.child_count; c-- > 0;) {
    next = task;
    next.kind = Task::join;
    next.child = c;
    tasks_.push_back(next);
    next.kind = Task::enter;
    next.node = node.first_child + c;
    next.point = point;
    next.depth = task.depth + 1;
    tasks_.push_back(next);
  }
}

void TreeText::enter(const Task& task) {
  const SdfNode& node = tree_.nodes[task.node];
  if (node.child_count == 0) {
    line(fmt::format("float d{} = {};", task.node, shape(node, task.node, task.point)));
    return material_line(
        fmt::format("pnb_Material m{} = pnb_material_of({});", task.node, node.material));
  }
  line(fmt::format("// {}", signature_of(node.op).name));
  if (node.op == SdfOp::repeat) return enter_repeat(task);
  if (signature_of(node.op).kind == SdfKind::transform) return enter_transform(task);
  push_children(task, task.point);
}

void TreeText::enter_transform(Task task) {
  const SdfNode& node = tree_.nodes[task.node];
  const auto n = tree_.numbers_of(node);
  const std::string p = task.point, q = fmt::format("p{}", task.node);
  const auto set = [&](const std::string& value) { line("vec3 " + q + " = " + value + ';'); };
  if (node.op == SdfOp::translate) set(p + " - " + vector(n));
  if (node.op == SdfOp::rotate) set(p + " * " + matrix(rotation_deg(vec(n))));
  if (node.op == SdfOp::scale) set(p + " / " + vector(n));
  if (node.op == SdfOp::mirror) set(fmt::format("mix({0}, abs({0}), {1})", p, vector(n)));
  if (node.op == SdfOp::elongate) set(fmt::format("{0} - clamp({0}, -{1}, {1})", p, vector(n)));
  if (node.op == SdfOp::twist || node.op == SdfOp::bend) {
    const char* plane = node.op == SdfOp::twist ? "xz" : "xy";
    const char* along = node.op == SdfOp::twist ? "y" : "x";
    const float reach = std::min(slopes_[task.node].reach, 1e30f);
    set(p);
    line(fmt::format("vec3 e{} = pnb_pulled({}.{}, {});", task.node, p, plane, number(reach)));
    line(fmt::format("{}.{} = e{}.xy;", q, plane, task.node));
    line(fmt::format("{0}.{1} = pnb_turned({0}.{1}, {0}.{2} * {3});", q, plane, along,
                     number(n[0])));
  }
  push_children(task, q);
}

// Each copy is a call of the child's function.
void TreeText::enter_repeat(const Task& task) {
  const SdfNode& node = tree_.nodes[task.node];
  const auto n = tree_.numbers_of(node);
  CopyCounts counts = copies_of(tree_, node, bounds_);
  int total = 1;
  for (const int c : counts.along) total *= std::max(c, 1);
  if (total > 1 && task.copies * total > kMostCopies) {
    for (int& c : counts.along) c = std::min(c, 1);
    total = 1;
  }
  const auto limit = [&](int i) { return n[3 + i] < 0 ? 1e30 : n[3 + i]; };
  const std::string limits = vector(Vec3d(limit(0), limit(1), limit(2)));
  const std::string part = part_name(node.first_child);
  want_part(node.first_child, task.copies * total);
  // Copies of copies are counted by loops: compilers write every call out.
  if (task.copies > 1 && total > 1) return loop_over_copies(task, counts, limits);
  bool first = true;
  for (int copy = 0; copy < 8; ++copy) {
    const Vec3d next(copy & 1, copy >> 1 & 1, copy >> 2 & 1);
    bool wanted = true;
    for (int i = 0; i < 3; ++i) wanted = wanted && next[i] < std::max(counts.along[i], 1);
    if (!wanted) continue;
    const std::string call = fmt::format("{}(pnb_copy({}, {}, {}, {})", part, task.point, vector(n),
                                         limits, vector(next));
    const std::string d = fmt::format("d{}", task.node), m = fmt::format("m{}", task.node);
    if (!shade_) {
      line(first ? fmt::format("float {} = {});", d, call)
                 : fmt::format("{0} = min({0}, {1}));", d, call));
    } else if (first) {
      line(fmt::format("pnb_Material {}, o{};", m, task.node));
      line(fmt::format("float {} = {}, {}), c{};", d, call, m, task.node));
    } else {
      line(fmt::format("c{0} = {1}, o{0});", task.node, call));
      line(fmt::format("if (c{0} < d{0}) m{0} = o{0};", task.node));
      line(fmt::format("d{0} = min(d{0}, c{0});", task.node));
    }
    first = false;
  }
}

void TreeText::loop_over_copies(const Task& task, const CopyCounts& counts,
                                const std::string& limits) {
  const SdfNode& node = tree_.nodes[task.node];
  int size[3];
  for (int i = 0; i < 3; ++i) size[i] = std::max(counts.along[i], 1);
  const std::string call =
      fmt::format("{}(pnb_copy({}, {}, {}, vec3(i % {}, i / {} % {}, i / {}))",
                  part_name(node.first_child), task.point, vector(tree_.numbers_of(node)), limits,
                  size[0], size[0], size[1], size[0] * size[1]);
  const std::string loop = fmt::format("for (int i = 0; i < {}; ++i)", size[0] * size[1] * size[2]);
  if (!shade_) {
    line(fmt::format("float d{} = 1e30;", task.node));
    return line(fmt::format("{1} d{0} = min(d{0}, {2}));", task.node, loop, call));
  }
  line(fmt::format("pnb_Material m{0}, o{0};", task.node));
  line(fmt::format("float d{0} = 1e30, c{0};", task.node));
  line(loop + " {");
  line(fmt::format("  c{0} = {1}, o{0});", task.node, call));
  line(fmt::format("  if (c{0} < d{0}) d{0} = c{0}, m{0} = o{0};", task.node));
  line("}");
}

void TreeText::want_part(std::uint32_t node, int copies) {
  if (std::none_of(parts_.begin(), parts_.end(), [&](const Part& p) { return p.node == node; }))
    parts_.push_back({node, copies});
}

std::string TreeText::operand(const SdfNode& parent, std::uint32_t child) const {
  const float slope = divides_children(parent.op) ? slopes_[child].constant : 1;
  return slope > 1 ? fmt::format("d{} / {}", child, number(slope)) : fmt::format("d{}", child);
}

void TreeText::join(const Task& task) {
  const SdfNode& node = tree_.nodes[task.node];
  const std::uint32_t child = node.first_child + task.child;
  const std::string d = operand(node, child);
  if (task.child == 0) {
    line(fmt::format("float d{} = {};", task.node, d));
    return material_line(fmt::format("pnb_Material m{} = m{};", task.node, child));
  }
  if (is_smooth(node.op) && tree_.numbers_of(node)[0] > 0)
    return join_smoothly(node, task.node, d, child);
  const bool least = node.op == SdfOp::union_ || node.op == SdfOp::smooth_union;
  const bool negative = node.op == SdfOp::difference || node.op == SdfOp::smooth_difference;
  const std::string v = negative ? "-" + d : d;
  material_line(
      fmt::format("if ({} {} d{}) m{} = m{};", v, least ? '<' : '>', task.node, task.node, child));
  line(fmt::format("d{0} = {1}(d{0}, {2});", task.node, least ? "min" : "max", v));
}

void TreeText::join_smoothly(const SdfNode& node, std::uint32_t index, const std::string& d,
                             std::uint32_t child) {
  const std::string k = number(tree_.numbers_of(node)[0]);
  const bool least = node.op == SdfOp::smooth_union;
  const std::string v = node.op == SdfOp::smooth_difference ? "-" + d : d;
  // Of maxima the greater shows: as the lesser of their negatives.
  const std::string a = fmt::format("{}d{}", least ? "" : "-", index);
  const std::string b = least ? v : node.op == SdfOp::smooth_difference ? d : "-" + d;
  material_line(fmt::format("m{0} = pnb_mix_materials(m{0}, m{1}, pnb_share({2}, {3}, {4}));",
                            index, child, a, b, k));
  line(fmt::format("d{0} = pnb_smooth_{1}(d{0}, {2}, {3});", index, least ? "min" : "max", v, k));
}

void TreeText::leave(const Task& task) {
  const SdfNode& node = tree_.nodes[task.node];
  const auto n = tree_.numbers_of(node);
  const std::string d = fmt::format("d{}", task.node);
  const auto set = [&](const std::string& value) { line(d + " = " + value + ';'); };
  if (node.op == SdfOp::onion) set(fmt::format("abs({}) - {}", d, number(n[0])));
  if (node.op == SdfOp::round) set(fmt::format("{} - {}", d, number(n[0])));
  if (node.op == SdfOp::displace) {
    line(fmt::format("vec3 s{} = sin({} * {});", task.node, task.point, vector(n.subspan(1))));
    set(fmt::format("{0} + {1} * s{2}.x * s{2}.y * s{2}.z", d, number(n[0]), task.node));
  }
  if (node.op == SdfOp::scale)
    set(fmt::format("{} * {}", d,
                    number(std::min({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])}))));
  if (node.op == SdfOp::twist || node.op == SdfOp::bend)
    set(fmt::format("pnb_beyond(e{}.z, {})", task.node, d));
}

}  // namespace penumbra::sdf
