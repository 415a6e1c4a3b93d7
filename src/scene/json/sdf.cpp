#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "base/atomic_file.h"
#include "base/cancel.h"
#include "scene/glsl_source.h"
#include "scene/json/builder.h"
#include "scene/json/keyframes.h"
#include "scene/json/sdf_parameters.h"
#include "scene/sdf_path.h"

namespace penumbra::json {
namespace {

// A node that is still to be read.
struct Pending {
  const Json::Value* value;
  std::uint32_t parent;
  std::int32_t index;  ///< in "children"; -1 for a "child" or the root
};

class TreeReader {
 public:
  TreeReader(Builder& builder, SdfTree& tree) : builder_(builder), tree_(tree) {}

  // Breadth first, so that children follow one another and no depth is too deep.
  void read(const Json::Value& root, std::uint32_t material) {
    add(root, 0, -1, material);
    for (std::uint32_t i = 0; i < pending_.size(); ++i) {
      if (i % 1024 == 0) throw_if_cancelled();
      read_node(i);
    }
  }

 private:
  void add(const Json::Value& value, std::uint32_t parent, std::int32_t index,
           std::uint32_t material) {
    pending_.push_back({&value, parent, index});
    tree_.nodes.emplace_back().material = material;
  }

  std::string path(std::uint32_t node) const {
    std::vector<std::int32_t> steps;
    for (std::uint32_t i = node; i != 0; i = pending_[i].parent) steps.push_back(pending_[i].index);
    std::ranges::reverse(steps);
    return sdf_path(steps);
  }

  void read_node(std::uint32_t i) {
    ObjectReader reader(builder_.document, *pending_[i].value, path(i));
    const SdfSignature& signature = signature_in(reader);
    reader.set_noun(fmt::format("the {} at {}", signature.name, reader.noun()));
    SdfNode node;
    node.op = signature.op;
    node.first_number = static_cast<std::uint32_t>(tree_.numbers.size());
    read_parameters(reader, signature, tree_.numbers);
    if (signature.has_profile) node.profile = read_profile(reader, tree_.numbers);
    node.number_count = static_cast<std::uint32_t>(tree_.numbers.size()) - node.first_number;
    node.material = tree_.nodes[i].material;
    if (const auto own = optional_material(builder_, reader)) node.material = visible(*own);
    node.first_child = static_cast<std::uint32_t>(tree_.nodes.size());
    if (signature.most_children > 0) add_children(reader, signature, i, node.material);
    node.child_count = static_cast<std::uint32_t>(tree_.nodes.size()) - node.first_child;
    know_keyframes(reader);
    reader.done();
    check_parameters(reader, node.op, tree_.numbers_of(node));
    tree_.nodes[i] = node;
  }

  // "shape" or "op", and which.
  const SdfSignature& signature_in(ObjectReader& reader) const {
    const Json::Value *shape = reader.find("shape"), *op = reader.find("op");
    if ((shape != nullptr) == (op != nullptr))
      reader.refuse_key("op",
                        fmt::format("{} has {} \"shape\" {} \"op\"", reader.noun(),
                                    shape ? "both" : "neither", shape ? "and" : "nor"),
                        "give a \"shape\", or an \"op\" with its children");
    std::vector<std::string_view> names;
    std::vector<SdfOp> ops;
    const std::string name =
        text({reader.document(), shape ? *shape : *op, shape ? "shape" : "op", reader.noun()});
    for (const SdfSignature& s : sdf_signatures()) {
      if ((s.kind == SdfKind::shape) == (shape != nullptr))
        names.push_back(s.name), ops.push_back(s.op);
      else if (name == s.name)
        reader.refuse_key(
            shape ? "shape" : "op",
            fmt::format("\"{}\" at {} is no {}", name, reader.noun(), shape ? "shape" : "op"),
            fmt::format("write \"{}\": \"{}\"", shape ? "op" : "shape", name));
    }
    const std::size_t index =
        reader.index_of_name(shape ? "shape" : "op", shape ? "shape" : "op", names);
    return signature_of(ops[index]);
  }

  void add_children(ObjectReader& reader, const SdfSignature& signature, std::uint32_t parent,
                    std::uint32_t material) {
    const Json::Value* child = signature.most_children == 1 ? reader.find("child") : nullptr;
    const Json::Value* list = reader.find("children");
    if (child && list)
      reader.refuse_key(
          "children", fmt::format("both \"child\" and \"children\" are given in {}", reader.noun()),
          "give one of them");
    if (child) return add(*child, parent, -1, material);
    if (!list) return reader.miss(signature.most_children == 1 ? "child" : "children");
    array({reader.document(), *list, "children", reader.noun()});
    if (list->empty())
      reader.refuse_key("children", fmt::format("{} has no children", reader.noun()),
                        "give at least one");
    if (list->size() > static_cast<unsigned>(signature.most_children))
      reader.refuse_key("children", fmt::format("{} has {} children", reader.noun(), list->size()),
                        "give one; a union joins several");
    for (Json::ArrayIndex i = 0; i < list->size(); ++i)
      add((*list)[i], parent, static_cast<std::int32_t>(i), material);
  }

  std::uint32_t visible(std::uint32_t material) {
    return untextured(builder_, material, "distance fields");
  }

  Builder& builder_;
  SdfTree& tree_;
  std::vector<Pending> pending_;
};

void warn_of_emission(Scene& scene, const SdfTree& tree) {
  for (const SdfNode& node : tree.nodes) {
    const Material& material = scene.materials[node.material];
    if (!(max_component(material.emission) > 0)) continue;
    scene.report.warnings.push_back(
        fmt::format("the distance field \"{}\" glows by material \"{}\" without lighting the scene",
                    scene.objects[tree.object].name, material.name));
    return;
  }
}

}  // namespace

void read_sdf(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const Json::Value* root = reader.find("root");
  if (!root) reader.miss("root");
  const std::uint32_t material = required_material(builder, reader);
  reader.done();
  SdfTree tree;
  tree.object = object;
  TreeReader(builder, tree).read(*root, untextured(builder, material, "distance fields"));
  warn_of_emission(builder.scene, tree);
  builder.scene.sdfs.push_back(std::move(tree));
}

void read_glsl(Builder& builder, ObjectReader& reader, std::uint32_t object) {
  const std::string file = reader.required("file", file_name);
  reader.done();
  const std::optional<std::string> path = builder.document.find_file(file);
  if (!path)
    reader.refuse_key("file", fmt::format("there is no shader file \"{}\"", file),
                      "name one relative to the scene file");
  if (builder.scene.glsl)
    reader.refuse_key("type", "a scene holds one \"glsl\" object, and this is the second",
                      "join their map() functions in one file");
  builder.scene.glsl = read_glsl_source(*path);
  builder.scene.glsl->object = object;
}

}  // namespace penumbra::json
