// The workloads of Heckbert and Herf (1997), sections 5 and 6, rebuilt: as many polygons,
// receivers, lights, samples and texels.
#pragma once

#include <vector>

#include "bake/bake_options.h"
#include "bake/chart.h"
#include "scene/scene.h"

namespace penumbra::bench {

/// A scene, the surfaces that receive, and how their lights are sampled.
struct BakeScene {
  Scene scene;
  std::vector<bake::PlanarChart> charts;
  bake::BakeOptions options;
  std::size_t movable = 0;  ///< a mesh that stands free

  std::size_t triangle_count() const;
  std::size_t texel_count() const;
};

/// A floor and two walls under two rectangular lights with `samples` points each, and furniture
/// until there are `polygons` triangles; `texels` on floor and walls together.
BakeScene room(int polygons, int samples, int texels);
/// The same with 49 points a light, and a table whose top takes 9 and whose legs take 4: 25
/// receivers.
BakeScene room_with_table(int polygons, int texels);
/// Boxes in a room until there are about `polygons` triangles, all of them receivers, `texels`
/// together at most 1.5 times.
BakeScene boxes(int polygons, int samples, int texels);

}  // namespace penumbra::bench
