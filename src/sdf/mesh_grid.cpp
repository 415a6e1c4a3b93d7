#include "sdf/mesh_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "sdf/distance_levels.h"

namespace penumbra::sdf {
namespace {

constexpr int cells = DistanceLevels::cells, corners = DistanceLevels::corners;
// In voxels: the triangles alone below, the grid alone beyond.
constexpr float exact_below = 3, grid_from = 4;
constexpr float finest_voxel = 1.0f / (1 << 16);  // of the longest side, so that floats count cells
constexpr double default_cells = 128;

// Voxels that the grid is moved by, so that the ways between its points do not run along edges.
constexpr Vec3d off_symmetry{0.1373, 0.3119, 0.2191};

Bounds bounds_of(const Mesh& mesh) {
  Bounds box;
  for (const std::uint32_t i : mesh.indices) box.grow(mesh.positions[i]);
  return box;
}

// A mesh of a single point has the unit for its size.
double longest_side(const Bounds& box) {
  const double side = box.empty() ? 0 : max_component(Vec3d(box.hi) - Vec3d(box.lo));
  return side > 0 ? side : 1;
}

std::uint64_t checksum_of(const Mesh& mesh) {
  std::uint64_t hash = mesh.indices.size();
  const auto take = [&](float x) {
    hash = (std::rotl(hash, 23) ^ std::bit_cast<std::uint32_t>(x)) * 0xff51afd7ed558ccdu;
  };
  for (const std::uint32_t i : mesh.indices) {
    const Vec3& p = mesh.positions[i];
    take(p.x), take(p.y), take(p.z);
  }
  return hash ^ hash >> 29;
}

[[noreturn]] void refuse(const Mesh& mesh, const GridOptions& options) {
  const double voxel = voxel_size_of(mesh, options);
  throw InputError(
      fmt::format("--voxel-size: the distances to mesh \"{}\" by voxels of {:.3g} m take more than "
                  "{} MiB",
                  mesh.name, voxel, options.most_bytes >> 20),
      fmt::format("give larger ones, say --voxel-size {:.2g}", 2 * voxel));
}

/// The cell of a point: where it lies within, and the values at its corners.
struct Cell {
  int level;
  Vec3 at;  ///< in [0, 1]³
  float values[8];

  float trilinear() const {
    float x[4];
    for (int i = 0; i < 4; ++i) {
      const float a = std::abs(values[2 * i]), b = std::abs(values[2 * i + 1]);
      x[i] = a + at.x * (b - a);
    }
    const float lo = x[0] + at.y * (x[1] - x[0]), hi = x[2] + at.y * (x[3] - x[2]);
    return lo + at.z * (hi - lo);
  }
  Vec3 to_corner(int i) const {
    return Vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                static_cast<float>(i >> 2)) -
           at;
  }
  int nearest_corner() const {
    return (at.x > 0.5f ? 1 : 0) + (at.y > 0.5f ? 2 : 0) + (at.z > 0.5f ? 4 : 0);
  }
};

// The trilinear value less what it may be too much, both in cells.
float less_error(float m) { return m - 0.25f / (m - std::sqrt(3.0f)); }

}  // namespace

struct MeshGrid::Data {
  Vec3d center;
  double side = 1;  ///< metres a unit
  double voxel = 0;
  float ball_radius = 0;  ///< of the unit frame's mesh about the origin
  bool is_closed = true, was_cached = false;
  TriangleTree triangles;
  DistanceLevels levels;

  Vec3 unit(const Vec3& p) const { return Vec3((Vec3d(p) - center) * (1 / side)); }
  bool find(const Vec3& p, Cell& cell) const;
  float distance(const Vec3& p) const;
  bool is_inside(const Cell& cell, const Vec3& p, float d) const;
  float near_surface(const Cell& cell, const Vec3& p, float m) const;
};

// False outside of the root cube.
bool MeshGrid::Data::find(const Vec3& p, Cell& cell) const {
  const int half = cells / 2 << (levels.levels - 1);
  const Vec3 s = p * (1 / levels.voxel);
  const float limit = static_cast<float>(half);
  if (!(max_component(abs(s)) < limit)) return false;
  int at[3];
  for (int i = 0; i < 3; ++i)
    at[i] = std::clamp(static_cast<int>(std::floor(s[i])) + half, 0, 2 * half - 1);
  int shift = std::countr_zero(static_cast<unsigned>(2 * half));  // of the root cube's side
  std::int32_t node = levels.nodes[0];
  while (node >= 0) {
    --shift;
    const int child = (at[0] >> shift & 1) | (at[1] >> shift & 1) << 1 | (at[2] >> shift & 1) << 2;
    node = levels.nodes[static_cast<std::size_t>(node + child)];
  }
  cell.level = shift - std::countr_zero(static_cast<unsigned>(cells));
  int corner[3];
  for (int i = 0; i < 3; ++i) {
    const int lo = at[i] >> cell.level << cell.level;
    cell.at[i] =
        std::clamp(std::ldexp(s[i] - static_cast<float>(lo - half), -cell.level), 0.0f, 1.0f);
    corner[i] = at[i] >> cell.level & (cells - 1);
  }
  const float* v = &levels.values[static_cast<std::size_t>(~node) * DistanceLevels::brick_values +
                                  static_cast<std::size_t>(
                                      corner[0] + corners * (corner[1] + corners * corner[2]))];
  for (int i = 0; i < 8; ++i)
    cell.values[i] = v[(i & 1) + corners * (i >> 1 & 1) + corners * corners * (i >> 2)];
  return true;
}

// p is on a corner's side where no triangle is nearer to one of them than they are to one another.
bool MeshGrid::Data::is_inside(const Cell& cell, const Vec3& p, float d) const {
  const float h = levels.voxel;
  for (int i = 0; i < 8; ++i) {
    const float way = 1.001f * length(cell.to_corner(i));
    if (std::max(std::abs(cell.values[i]), d) > way * h) return cell.values[i] < 0;
  }
  const DistanceSource source{triangles, is_closed};
  const int nearest = cell.nearest_corner();
  const auto winding = winding_in(cell.values[nearest]);
  if (!winding) return source.is_inside(triangles.winding(p));
  const int between = triangles.crossings(p + cell.to_corner(nearest) * h, p);
  return source.is_inside(static_cast<float>(*winding + between));
}

// d is at most half a diagonal below the interpolated m.
float MeshGrid::Data::near_surface(const Cell& cell, const Vec3& p, float m) const {
  const float h = levels.voxel;
  const float d = triangles.distance(p, (m + 0.87f) * h);
  const float grid = m > exact_below ? less_error(m) * h : 0;
  const float t = std::clamp((m - exact_below) / (grid_from - exact_below), 0.0f, 1.0f);
  const float size = d + t * (grid - d);
  return is_inside(cell, p, d) ? -size : size;
}

float MeshGrid::Data::distance(const Vec3& p) const {
  Cell cell;
  if (!find(p, cell)) return length(p) - ball_radius;
  const float h = std::ldexp(levels.voxel, cell.level);
  const float m = cell.trilinear() / h;
  if (cell.level == 0 && m < grid_from) return near_surface(cell, p, m);
  const float d = less_error(m) * h;
  return cell.values[cell.nearest_corner()] < 0 ? -d : d;
}

MeshGrid::MeshGrid(const Mesh& mesh, const GridOptions& options) : data_(std::make_unique<Data>()) {
  Data& data = *data_;
  data.voxel = voxel_size_of(mesh, options);
  if (mesh.indices.empty()) return;
  const Bounds box = bounds_of(mesh);
  data.center = (Vec3d(box.lo) + Vec3d(box.hi)) * 0.5;
  data.side = longest_side(box);
  data.center += off_symmetry * data.voxel;
  std::vector<Vec3> positions(mesh.positions.size());
  std::ranges::transform(mesh.positions, positions.begin(),
                         [&](const Vec3& p) { return data.unit(p); });
  for (const std::uint32_t i : mesh.indices)
    data.ball_radius = std::max(data.ball_radius, length(positions[i]));
  data.is_closed = sdf::is_closed(positions, mesh.indices);
  data.triangles = TriangleTree(positions, mesh.indices);
  const auto voxel = static_cast<float>(data.voxel / data.side);
  if (voxel < finest_voxel) refuse(mesh, options);
  const GridKey key{checksum_of(mesh), data.voxel};
  auto cached = options.cache.empty() ? std::nullopt
                                      : read_levels(options.cache, voxel, options.most_bytes, key);
  data.was_cached = cached.has_value();
  try {
    data.levels = cached ? std::move(*cached)
                         : build_levels({data.triangles, data.is_closed}, voxel, options.most_bytes,
                                        key, options.cache);
  } catch (const GridTooLarge&) {
    refuse(mesh, options);
  }
}

MeshGrid::~MeshGrid() = default;
MeshGrid::MeshGrid(MeshGrid&&) noexcept = default;
MeshGrid& MeshGrid::operator=(MeshGrid&&) noexcept = default;

float MeshGrid::distance(const Vec3& p) const {
  if (data_->triangles.empty()) return std::numeric_limits<float>::infinity();
  return static_cast<float>(data_->distance(data_->unit(p)) * data_->side);
}

Vec3 MeshGrid::gradient(const Vec3& p) const {
  if (data_->triangles.empty()) return {0, 1, 0};
  const Vec3 at = data_->unit(p);
  const TriangleTree::Nearest nearest = data_->triangles.nearest(at);
  const float rounding = 1e-6f * std::max(1.0f, length(at));
  const bool is_off = nearest.distance > rounding;
  const Vec3d way(is_off ? at - nearest.point : nearest.normal);
  if (!(dot(way, way) > 0)) return {0, 1, 0};
  const Vec3 direction = Vec3(normalize(way));
  return is_off && data_->distance(at) < 0 ? -direction : direction;
}

// |value| is above 0.7 of the distance d everywhere: the worst is 4 voxels from the surface.
DistanceRange MeshGrid::range(const Vec3& center, float radius) const {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (data_->triangles.empty()) return {infinity, infinity};
  const Vec3 at = data_->unit(center);
  const auto r = static_cast<float>(radius / data_->side);
  const float d = data_->triangles.nearest(at).distance;
  const auto metres = [&](float x) { return static_cast<float>(x * data_->side); };
  const float most = metres((d + r) * 1.0001f), least = metres(0.7f * std::max(0.0f, d - r));
  if (d <= r || !data_->is_closed) return {-most, most};
  return data_->distance(at) < 0 ? DistanceRange{-most, -least} : DistanceRange{least, most};
}

MeshGrid::Frame MeshGrid::frame() const { return {data_->center, data_->side, data_->ball_radius}; }
const DistanceLevels& MeshGrid::levels() const { return data_->levels; }
const TriangleTree& MeshGrid::triangles() const { return data_->triangles; }
double MeshGrid::voxel_size() const { return data_->voxel; }
bool MeshGrid::was_cached() const { return data_->was_cached; }
bool MeshGrid::is_closed() const { return data_->is_closed; }
std::size_t MeshGrid::memory_bytes() const {
  return sizeof(Data) + data_->triangles.memory_bytes() + data_->levels.memory_bytes();
}

double voxel_size_of(const Mesh& mesh, const GridOptions& options) {
  return options.voxel_size ? *options.voxel_size : longest_side(bounds_of(mesh)) / default_cells;
}

bool is_cached(const Mesh& mesh, const GridOptions& options) {
  return !options.cache.empty() && has_levels(options.cache, options.most_bytes,
                                              {checksum_of(mesh), voxel_size_of(mesh, options)});
}

}  // namespace penumbra::sdf
