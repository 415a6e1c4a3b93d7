// The scenes of tests/data/oracle with their true visible fractions, and exact recomputations of
// what `hard` and `parker` are defined to give on spheres, boxes and quads, in double precision.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "geometry/brute_force.h"
#include "scene/finish.h"
#include "scene/load.h"
#include "shadow/shadows.h"

namespace penumbra::testing {

inline const std::vector<std::string>& oracle_names() {
  static const std::vector<std::string> names = {
      "three-spheres", "sphere-field", "bridge", "knife-edge", "thin-wall", "slats", "table"};
  return names;
}

struct OraclePoint {
  Receiver receiver;
  std::size_t light = 0;
  double truth = 0;
};

struct Oracle {
  Scene scene;
  std::vector<OraclePoint> points;

  explicit Oracle(const std::string& name) {
    const std::string stem = std::string(PENUMBRA_SOURCE_DIR "/tests/data/oracle/") + name;
    scene = load_scene(stem + ".json");
    std::ifstream csv(stem + ".csv");
    std::string line;
    std::getline(csv, line);
    while (std::getline(csv, line)) {
      for (char& c : line) c = c == ',' ? ' ' : c;
      std::istringstream in(line);
      OraclePoint p;
      Vec3 &x = p.receiver.position, &n = p.receiver.normal;
      in >> x.x >> x.y >> x.z >> n.x >> n.y >> n.z >> p.light >> p.truth;
      points.push_back(p);
    }
  }
};

/// Everything uniformly scaled about the origin, lights too.
inline Scene scaled(Scene scene, float f) {
  for (Mesh& mesh : scene.meshes)
    for (Vec3& p : mesh.positions) p *= f;
  for (Sphere& s : scene.spheres) s.center *= f, s.radius *= f;
  for (Light& l : scene.lights) {
    l.position *= f, l.edge_u *= f, l.edge_v *= f;
    l.radius *= f;
  }
  return scene;
}

/// The query that design and paper prescribe for one point and one light.
inline ConeQuery paper_query(const Scene& scene, const OraclePoint& p) {
  const auto view = LightViews(scene).view(p.light, p.receiver.position);
  ConeQuery q;
  q.origin = p.receiver.position, q.horizon = p.receiver.normal, q.epsilon = 1e-6f;
  q.direction = view->direction, q.distance = view->distance;
  q.outer = view->diameter_over_distance;
  q.has_plane = view->flat, q.plane_normal = view->plane_normal;
  q.plane_distance = view->plane_distance, q.plane_epsilon = 1e-6f;
  return q;
}

/// Least clearance by the paper's formulas over every sphere and every face of the scene.
inline double paper_clearance(const Scene& scene, const ConeQuery& q) {
  double least = q.outer;
  for (const Sphere& s : scene.spheres)
    least = std::min(least, sphere_clearance(Vec3d(s.center), s.radius, q));
  for (const Mesh& mesh : scene.meshes)
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      Polygon face;
      for (std::size_t v = 0; v < 3; ++v) face.emplace_back(mesh.positions[mesh.indices[t + v]]);
      least = std::min(least, polygon_clearance(face, q));
    }
  return least;
}

}  // namespace penumbra::testing
