// From lit charts to the primitives of a file.
#pragma once

#include <map>

#include "bake/bake.h"

namespace penumbra::bake {

/// Collects the triangles of charts: a node for each object, in it a primitive for each material.
class Assembly {
 public:
  Assembly(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

  /// A chart with its place in a page; `material` is that of the file.
  void add_textured(const CutChart& chart, const ChartPlace& place, const AtlasPage& page,
                    int material, bool keep_shading);
  /// A chart with colours at its vertices, exposed.
  void add_colored(const CutChart& chart, const std::vector<VertexColor>& colors, float scale,
                   int material);
  /// One side of an instance, with a colour for each vertex of its mesh or none.
  void add_plain(std::uint32_t instance, bool back, const std::vector<Vec3>& colors, int material,
                 bool keep_shading);

  /// By object, those without triangles left out.
  std::vector<GlbNode> take();
  /// Node name and primitive's place of each (object, material), after take().
  struct Part {
    std::string node;
    std::size_t primitive;
    int material;
  };
  const std::vector<Part>& parts() const { return parts_; }

 private:
  GlbPrimitive& primitive(std::uint32_t instance, int material);
  template <class Append>
  void add_triangles(const WorldMesh& mesh, std::span<const std::uint32_t> triangles, bool back,
                     GlbPrimitive& out, const Append& append);
  void append_shading(const WorldMesh& mesh, std::uint32_t triangle, int corner, bool back,
                      GlbPrimitive& out) const;

  const Scene& scene_;
  const Plan& plan_;
  std::map<std::pair<std::uint32_t, int>, GlbPrimitive> primitives_;  ///< by object and material
  std::vector<Part> parts_;
};

}  // namespace penumbra::bake
