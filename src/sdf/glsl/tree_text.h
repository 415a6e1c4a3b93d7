// One tree as GLSL functions. Internal to the room.
#pragma once

#include <string>
#include <vector>

#include "sdf/lipschitz.h"

namespace penumbra::sdf {

/// Writes functions of a point for a tree. Every node becomes a variable d<index>, lines are
/// indented by the node's depth, and what is evaluated more than once (repeat's child) becomes a
/// function of its own.
class TreeText {
 public:
  /// `name`: that of the functions; `object`: for warnings and comments.
  TreeText(const SdfTree& tree, std::string name, const std::string& object,
           std::vector<std::string>& warnings);

  /// float NAME(vec3 p): the field, divided by its slope; after the functions that it needs.
  std::string value_functions();
  /// float NAME_shade(vec3 p, out pnb_Material m): the same and what it is made of there.
  std::string shade_functions();
  /// Every node that shows has this material; no value if there are several.
  bool has_one_material() const;

 private:
  struct Task {
    enum Kind : std::uint8_t { enter, join, leave } kind = enter;
    std::uint32_t node = 0;
    std::uint32_t child = 0;  ///< join: which of the node's
    std::string point;        ///< variable of the point
    int depth = 1;
    int copies = 1;  ///< of repetitions around it
  };
  /// A subtree that is called by name.
  struct Part {
    std::uint32_t node;
    int copies;
  };

  std::string functions();
  void write_part(const Part& part);
  void run(const Task& task);
  void enter(const Task& task);
  void enter_transform(Task task);
  void enter_repeat(const Task& task);
  void loop_over_copies(const Task& task, const CopyCounts& counts, const std::string& limits);
  void want_part(std::uint32_t node, int copies);
  void join(const Task& task);
  void leave(const Task& task);
  void push_children(const Task& task, const std::string& point);
  void join_smoothly(const SdfNode& node, std::uint32_t index, const std::string& d,
                     std::uint32_t child);
  std::string shape(const SdfNode& node, std::uint32_t index, const std::string& p);
  std::string profile(const SdfNode& node, std::uint32_t index, const std::string& q);
  std::string part_name(std::uint32_t node) const;
  std::string signature(std::uint32_t node) const;
  /// The child's value; divided by its slope where the parent is a hard operator.
  std::string operand(const SdfNode& parent, std::uint32_t child) const;
  void line(const std::string& text);
  void material_line(const std::string& text);

  const SdfTree& tree_;
  std::string name_, object_;
  std::vector<std::string>& warnings_;
  std::vector<Bounds> bounds_;
  std::vector<NodeSlope> slopes_;
  bool shade_ = false;
  std::vector<Task> tasks_;
  std::vector<Part> parts_;
  std::string body_, outlines_;
  int depth_ = 1;
};

/// float NAME(vec2 p): the distance to a polygon's outline, negative inside. Vertices as x, y, …
std::string outline_function(const std::string& name, std::span<const double> vertices);

}  // namespace penumbra::sdf
