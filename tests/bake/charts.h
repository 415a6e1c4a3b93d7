// Receivers for tests: a parallelogram as a chart.
#pragma once

#include "bake/chart.h"
#include "scene/scene.h"

namespace penumbra::bake {

inline PlanarChart chart_on(const Vec3& base, const Vec3& edge_x, const Vec3& edge_y, int width,
                            int height) {
  PlanarChart chart;
  chart.base = base, chart.edge_x = edge_x, chart.edge_y = edge_y;
  chart.normal = normalize(cross(edge_x, edge_y));
  chart.width = width, chart.height = height;
  chart.instance = 0xffffffffu;
  return chart;
}

/// The quad that is instance `instance` of a scene, two triangles from add_quad.
inline PlanarChart chart_of_quad(const Scene& scene, std::uint32_t instance, int width,
                                 int height) {
  const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
  const auto& p = mesh.positions;
  PlanarChart chart = chart_on(p[0], p[1] - p[0], p[3] - p[0], width, height);
  chart.instance = instance;
  chart.triangles = {0, 1};
  return chart;
}

/// One texel round a point, in its tangent plane.
inline PlanarChart chart_at(const Vec3& position, const Vec3& normal, float size = 1e-4f) {
  const Frame f = frame_around(normal);
  PlanarChart chart = chart_on(position - (f.u + f.v) * (size / 2), f.u * size, f.v * size, 1, 1);
  chart.normal = normal;
  return chart;
}

}  // namespace penumbra::bake
