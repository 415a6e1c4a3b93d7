// One cone query at a time, for profiling the walk: against a rough ball of triangles, with rays
// that miss it widely, graze it, or hit it.
#include <benchmark/benchmark.h>

#include <cmath>

#include "geometry/cone_tree.h"
#include "shadow/profile.h"

namespace penumbra {
namespace {

Scene rough_ball(int rings) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"ball"});
  Mesh mesh;
  const auto n = static_cast<std::uint32_t>(rings);
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= 2 * n; ++j) {
      const float theta = 3.14159265f * (static_cast<float>(i) + 0.5f) / static_cast<float>(n + 1);
      const float phi = 3.14159265f * static_cast<float>(j) / static_cast<float>(n);
      const float r = 1 + 0.02f * std::sin(static_cast<float>(i * j % 97));
      mesh.positions.push_back({r * std::sin(theta) * std::cos(phi), r * std::cos(theta),
                                r * std::sin(theta) * std::sin(phi)});
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < 2 * n; ++j) {
      const std::uint32_t a = i * (2 * n + 1) + j, b = a + 2 * n + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, b, a + 1, b + 1});
    }
  scene.meshes.push_back(std::move(mesh));
  scene.instances.emplace_back();
  return scene;
}

// Arguments: distance of the rays from the ball's centre in hundredths, rings of the ball.
void least_clearance(benchmark::State& state) {
  const Scene scene = rough_ball(static_cast<int>(state.range(1)));
  const ConeTree tree(scene);
  const SearchLimit limit = search_limit(Profile::cubic, 0.02f);
  ConeQuery query;
  query.direction = {0, 1, 0}, query.horizon = {0, 1, 0};
  query.distance = 6, query.outer = 0.1f, query.epsilon = 1e-6f;
  ConeCounts counts;
  float turn = 0;
  for (auto _ : state) {
    const float d = static_cast<float>(state.range(0)) / 100;
    turn += 0.001f;
    query.origin = {d * std::cos(turn), -3, d * std::sin(turn)};
    benchmark::DoNotOptimize(tree.least_clearance(query, limit, counts));
  }
  const auto per_query = benchmark::Counter::kAvgIterations;
  state.counters["nodes"] = {static_cast<double>(counts.nodes), per_query};
  state.counters["leaves"] = {static_cast<double>(counts.leaves), per_query};
}
BENCHMARK(least_clearance)->ArgsProduct({{200, 110, 50}, {50, 500}});

}  // namespace
}  // namespace penumbra

BENCHMARK_MAIN();
