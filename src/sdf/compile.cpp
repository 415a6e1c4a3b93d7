#include "sdf/compile.h"

#include <fmt/format.h>

#include "sdf/compile_tree.h"
#include "sdf/leaves.h"
#include "sdf/mesh_distance.h"

namespace penumbra::sdf {
namespace {

// Objects join by union; the first begins the accumulator.
class SceneWriter {
 public:
  SceneWriter(const Scene& scene, const CompileOptions& options)
      : scene_(scene), options_(options) {}

  Tape write() {
    for (const SdfTree& tree : scene_.sdfs)
      write_tree(out_, tree, scene_.objects[tree.object].name, attach());
    if (!options_.only_distance_fields) {
      for (const Sphere& sphere : scene_.spheres)
        leaf(leaf_of(sphere), sphere.object, sphere.material);
      for (std::size_t i = 0; i < scene_.instances.size(); ++i) instance(i);
    }
    Tape& tape = out_.tape;
    tape.pool.shrink_to_fit(), tape.code.shrink_to_fit(), tape.info.shrink_to_fit();
    tape.runs = find_runs(tape);
    return std::move(tape);
  }

 private:
  Attach attach() const { return out_.size() == 0 ? Attach{} : Attach{Join::min, 0, 0}; }

  void leaf(const Leaf& leaf, std::uint32_t object, std::uint32_t material) {
    out_.shape(leaf.op, attach(), out_.surface(object, material), leaf.constants, 1);
  }

  void instance(std::size_t index) {
    const Instance& instance = scene_.instances[index];
    if (const auto exact = leaf_of(scene_.meshes[instance.mesh]))
      return leaf(*exact, instance.object, instance.material);
    auto mesh = options_.mesh_distance ? options_.mesh_distance(scene_, index) : nullptr;
    if (!mesh) {
      out_.tape.warnings.push_back(fmt::format("the mesh \"{}\" has no distance field: left out",
                                               scene_.meshes[instance.mesh].name));
      return;
    }
    const auto number = static_cast<float>(out_.tape.meshes.size());
    out_.tape.meshes.push_back(std::move(mesh));
    leaf({Op::mesh, {number}}, instance.object, instance.material);
  }

  const Scene& scene_;
  const CompileOptions& options_;
  TapeWriter out_;
};

}  // namespace

Tape compile(const Scene& scene, const CompileOptions& options) {
  return SceneWriter(scene, options).write();
}

}  // namespace penumbra::sdf
