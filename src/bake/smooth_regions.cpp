#include "bake/smooth_regions.h"

#include <algorithm>

namespace penumbra::bake {
namespace {

constexpr float grow_cosine = 0.5f, join_cosine = 0.26f;
constexpr std::uint32_t none = 0xffffffffu, free_triangle = none - 1;

class Regions {
 public:
  Regions(const WorldMesh& mesh, const Adjacency& adjacency, const TriangleIds& triangles)
      : mesh_(mesh), adjacency_(adjacency), region_(mesh.triangle_count(), none) {
    for (const std::uint32_t t : triangles) region_[t] = free_triangle;
  }

  void grow_from(std::uint32_t seed) {
    if (region_[seed] != free_triangle) return;
    const auto number = static_cast<std::uint32_t>(regions_.size());
    SmoothRegion& region = regions_.emplace_back();
    region.axis = mesh_.normal(seed);
    region.triangles = {seed};
    region_[seed] = number;
    for (std::size_t i = 0; i < region.triangles.size(); ++i)
      for (const std::uint32_t t : adjacency_.neighbours(region.triangles[i])) {
        if (region_[t] != free_triangle || dot(mesh_.normal(t), region.axis) < grow_cosine)
          continue;
        region_[t] = number;
        region.triangles.push_back(t);
      }
  }

  /// To the neighbour that most of its border triangles touch, if that sees all of it.
  void join_small(float least_area) {
    for (std::uint32_t i = 0; i < regions_.size(); ++i) {
      if (regions_[i].triangles.empty() || area(regions_[i]) >= least_area) continue;
      if (const std::uint32_t to = host_of(i); to != none) move(i, to);
    }
    std::erase_if(regions_, [](const SmoothRegion& r) { return r.triangles.empty(); });
  }

  std::vector<SmoothRegion> take() { return std::move(regions_); }

 private:
  float area(const SmoothRegion& region) const {
    float sum = 0;
    for (const std::uint32_t t : region.triangles) sum += mesh_.area(t);
    return sum;
  }

  bool sees(const SmoothRegion& host, const SmoothRegion& guest) const {
    return std::ranges::all_of(guest.triangles, [&](std::uint32_t t) {
      return dot(mesh_.normal(t), host.axis) > join_cosine;
    });
  }

  std::uint32_t host_of(std::uint32_t guest) const {
    std::vector<std::uint32_t> beside;
    for (const std::uint32_t t : regions_[guest].triangles)
      for (const std::uint32_t n : adjacency_.neighbours(t))
        if (region_[n] < free_triangle && region_[n] != guest) beside.push_back(region_[n]);
    std::ranges::sort(beside);
    std::uint32_t best = none;
    std::ptrdiff_t most = 0;
    for (auto i = beside.begin(); i != beside.end();) {
      const auto end = std::upper_bound(i, beside.end(), *i);
      if (end - i > most && sees(regions_[*i], regions_[guest])) best = *i, most = end - i;
      i = end;
    }
    return best;
  }

  void move(std::uint32_t from, std::uint32_t to) {
    for (const std::uint32_t t : regions_[from].triangles) region_[t] = to;
    auto& list = regions_[to].triangles;
    list.insert(list.end(), regions_[from].triangles.begin(), regions_[from].triangles.end());
    regions_[from].triangles.clear();
  }

  const WorldMesh& mesh_;
  const Adjacency& adjacency_;
  std::vector<std::uint32_t> region_;  // by triangle
  std::vector<SmoothRegion> regions_;
};

}  // namespace

std::vector<SmoothRegion> smooth_regions(const WorldMesh& mesh, const Adjacency& adjacency,
                                         const TriangleIds& triangles, float least_area) {
  TriangleIds order = triangles;
  std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t t) { return mesh.area(t); });
  Regions regions(mesh, adjacency, triangles);
  for (const std::uint32_t t : order) regions.grow_from(t);
  regions.join_small(least_area);
  return regions.take();
}

}  // namespace penumbra::bake
