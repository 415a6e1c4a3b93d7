#include "sdf/distance_levels.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tree/LeafManager.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <sstream>

#include "base/atomic_file.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"

namespace penumbra::sdf {
namespace {

using Grid = openvdb::FloatGrid;
using Reader = openvdb::tree::ValueAccessor<const Grid::TreeType, false>;

constexpr int cells = DistanceLevels::cells, corners = DistanceLevels::corners;
constexpr std::size_t brick_values = DistanceLevels::brick_values;
// Of a cube: its brick, and about its share of the sparse grid that it comes from.
constexpr std::size_t cube_bytes = (brick_values + 600) * sizeof(float);
// 4 of MeshGrid's contract, and as far as a point of a cell can be from a corner: √3 / 2.
constexpr float near_cells = 4.87f;

struct Cube {
  openvdb::Coord first;  ///< corner, in cells of its level
  std::size_t node;
};
struct Damaged {};

Vec3 position(const openvdb::Coord& at, int level, int levels, float voxel) {
  const int half = cells / 2 << (levels - 1);
  return Vec3(static_cast<float>((at.x() << level) - half),
              static_cast<float>((at.y() << level) - half),
              static_cast<float>((at.z() << level) - half)) *
         voxel;
}

float value_at(const Reader& reader, const openvdb::Coord& at) {
  float value;
  if (!reader.probeValue(at, value) || !std::isfinite(value)) throw Damaged{};
  return value;
}

template <class Take>
void for_each_corner(const Grid& grid, const Cube& cube, const Take& take) {
  const Reader reader(grid.tree());
  std::size_t i = 0;
  for (int z = 0; z < corners; ++z)
    for (int y = 0; y < corners; ++y)
      for (int x = 0; x < corners; ++x) take(i++, value_at(reader, cube.first.offsetBy(x, y, z)));
}

/// Puts the octree together from the top; `grid_of(level, cubes)` gives the level's values.
class Assembly {
 public:
  using GridOf = std::function<Grid::ConstPtr(int level, const std::vector<Cube>& cubes)>;

  Assembly(float voxel, std::size_t most_bytes, GridOf grid_of)
      : most_bytes_(most_bytes), grid_of_(std::move(grid_of)) {
    out_.voxel = voxel;
    out_.levels = level_count(voxel);
  }

  DistanceLevels run() {
    out_.nodes.push_back(0);
    std::vector<Cube> cubes{{openvdb::Coord(0), 0}};
    for (int level = out_.levels - 1; level >= 0; --level) cubes = take_level(level, cubes);
    return std::move(out_);
  }

 private:
  std::vector<Cube> take_level(int level, const std::vector<Cube>& cubes) {
    used_bytes_ += cubes.size() * cube_bytes;
    if (used_bytes_ > most_bytes_) throw GridTooLarge{};
    if (cubes.empty()) return {};
    const Grid::ConstPtr grid = grid_of_(level, cubes);
    const float least = level == 0 ? 0 : near_cells * std::ldexp(out_.voxel, level);
    std::vector<char> is_near(cubes.size());
    parallel_for(cubes.size(), [&](std::size_t i) {
      float nearest = INFINITY;
      for_each_corner(*grid, cubes[i],
                      [&](std::size_t, float v) { nearest = std::min(nearest, std::abs(v)); });
      is_near[i] = nearest < least;
    });
    std::vector<Cube> next;
    std::vector<std::size_t> leaves;
    for (std::size_t i = 0; i < cubes.size(); ++i)
      if (is_near[i])
        divide(cubes[i], next);
      else
        leaves.push_back(i);
    add_bricks(*grid, cubes, leaves);
    return next;
  }

  void divide(const Cube& cube, std::vector<Cube>& next) {
    const std::size_t first = out_.nodes.size();
    out_.nodes[cube.node] = static_cast<std::int32_t>(first);
    out_.nodes.resize(first + 8);
    for (int i = 0; i < 8; ++i)
      next.push_back({openvdb::Coord(2 * cube.first.x() + cells * (i & 1),
                                     2 * cube.first.y() + cells * (i >> 1 & 1),
                                     2 * cube.first.z() + cells * (i >> 2)),
                      first + static_cast<std::size_t>(i)});
  }

  void add_bricks(const Grid& grid, const std::vector<Cube>& cubes,
                  const std::vector<std::size_t>& leaves) {
    const std::size_t first = out_.values.size() / brick_values;
    out_.values.resize(out_.values.size() + leaves.size() * brick_values);
    parallel_for(leaves.size(), [&](std::size_t i) {
      const Cube& cube = cubes[leaves[i]];
      float* brick = &out_.values[(first + i) * brick_values];
      for_each_corner(grid, cube, [&](std::size_t k, float v) { brick[k] = v; });
      out_.nodes[cube.node] = ~static_cast<std::int32_t>(first + i);
    });
  }

  std::size_t most_bytes_, used_bytes_ = 0;
  GridOf grid_of_;
  DistanceLevels out_;
};

/// Fills the active voxels of one leaf.
class Sampler {
 public:
  Sampler(const DistanceSource& source, int level, int levels, float voxel)
      : source_(source), level_(level), levels_(levels), voxel_(voxel) {}

  template <class Leaf>
  void operator()(Leaf& leaf, std::size_t) const {
    throw_if_cancelled();
    State state;
    for (auto it = leaf.beginValueOn(); it; ++it) {
      step(state, position(it.getCoord(), level_, levels_, voxel_));
      const float d = source_.is_inside(state.winding) ? -state.distance : state.distance;
      it.setValue(with_winding(d, state.winding));
    }
  }

 private:
  struct State {
    bool is_first = true;
    Vec3 at;
    float distance = 0, winding = 0;
    std::size_t nearest = TriangleTree::no_triangle;
  };

  // What is known at one point bounds and mostly tells what is at the next.
  void step(State& s, const Vec3& p) const {
    const TriangleTree& triangles = source_.triangles;
    const float way = 1.0001f * length(p - s.at), before = s.distance;
    s.distance = triangles.distance(p, s.is_first ? INFINITY : before + way, s.nearest);
    if (s.is_first || (!source_.is_closed && is_doubtful(s)))
      s.winding = triangles.winding(p);
    else if (std::max(before, s.distance) <= way)
      s.winding += static_cast<float>(triangles.crossings(s.at, p));
    if (source_.is_closed) s.winding = std::round(s.winding);
    s.at = p, s.is_first = false;
  }

  // Near the surface the grid must know it; elsewhere it changes slowly.
  bool is_doubtful(const State& s) const {
    return s.distance < 2 * voxel_ || std::abs(s.winding - 0.6f) < 0.3f;
  }

  const DistanceSource& source_;
  int level_, levels_;
  float voxel_;
};

Grid::Ptr sampled(const DistanceSource& source, int level, int levels, float voxel,
                  const std::vector<Cube>& cubes) {
  auto grid = Grid::create(0);
  grid->setName("distance, level " + std::to_string(level));
  grid->setTransform(
      openvdb::math::Transform::createLinearTransform(std::ldexp(double{voxel}, level)));
  {
    auto writer = grid->getUnsafeAccessor();
    for (const Cube& cube : cubes)
      for (int z = 0; z < corners; ++z)
        for (int y = 0; y < corners; ++y)
          for (int x = 0; x < corners; ++x) writer.setValueOn(cube.first.offsetBy(x, y, z));
  }
  openvdb::tree::LeafManager<Grid::TreeType> leaves(grid->tree());
  leaves.foreach (Sampler(source, level, levels, voxel));
  return grid;
}

// The end of the file, behind what OpenVDB wrote.
struct Trailer {
  char magic[8] = {'p', 'e', 'n', 'u', 'm', 'b', 'r', 'a'};
  std::uint64_t version = 1;
  GridKey key;
  std::uint64_t size;      ///< of what is before
  std::uint64_t checksum;  ///< of it
};
static_assert(sizeof(Trailer) == 48);

std::uint64_t checksum_of(const char* bytes, std::size_t count) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u ^ count;
  for (std::size_t i = 0; i < count; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min<std::size_t>(8, count - i));
    hash = (std::rotl(hash, 23) ^ word) * 0xff51afd7ed558ccdu;
  }
  return hash ^ hash >> 31;
}

void initialize() {
  static std::once_flag once;
  std::call_once(once, [] { openvdb::initialize(); });
}

void write_levels(const openvdb::GridCPtrVec& grids, const GridKey& key, const std::string& file) {
  std::ostringstream stream;
  openvdb::io::Stream(stream).write(grids);
  std::string bytes = std::move(stream).str();
  const Trailer trailer{
      .key = key, .size = bytes.size(), .checksum = checksum_of(bytes.data(), bytes.size())};
  bytes.append(reinterpret_cast<const char*>(&trailer), sizeof trailer);
  static std::mutex mutex;  // threads would share the temporary file, processes do not
  const std::lock_guard lock(mutex);
  try {
    write_file(file, bytes);
  } catch (const WorkError&) {  // it is only a cache
  }
}

bool fits(const Trailer& trailer, const GridKey& key, std::uint64_t size) {
  const Trailer expected{.key = key, .size = size - sizeof trailer, .checksum = trailer.checksum};
  return std::memcmp(&trailer, &expected, sizeof trailer) == 0;
}

// What OpenVDB wrote, if the file is whole.
std::optional<std::string> grids_in(const std::string& file, std::size_t most_bytes,
                                    const GridKey& key) {
  if (!has_levels(file, most_bytes, key)) return {};
  std::string bytes = read_file(file);
  if (bytes.size() < sizeof(Trailer)) return {};
  Trailer trailer{.key = key, .size = 0, .checksum = 0};
  const std::size_t size = bytes.size() - sizeof trailer;
  std::memcpy(&trailer, bytes.data() + size, sizeof trailer);
  if (!fits(trailer, key, bytes.size()) || trailer.checksum != checksum_of(bytes.data(), size))
    return {};
  bytes.resize(size);
  return bytes;
}

DistanceLevels levels_from(std::string bytes, float voxel, std::size_t most_bytes) {
  std::istringstream stream(std::move(bytes));
  const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(stream, false).getGrids();
  std::size_t next = 0;
  return Assembly(voxel, most_bytes,
                  [&](int, const std::vector<Cube>&) -> Grid::ConstPtr {
                    if (next == grids->size()) throw Damaged{};
                    auto grid = openvdb::GridBase::grid<Grid>((*grids)[next++]);
                    if (!grid) throw Damaged{};
                    return grid;
                  })
      .run();
}

}  // namespace

int level_count(float voxel) {
  int levels = 1;
  while (std::ldexp(cells * voxel, levels - 1) < 64) ++levels;
  return levels;
}

DistanceLevels build_levels(const DistanceSource& source, float voxel, std::size_t most_bytes,
                            const GridKey& key, const std::string& file) {
  initialize();
  openvdb::GridCPtrVec grids;
  const int levels = level_count(voxel);
  DistanceLevels result =
      Assembly(voxel, most_bytes, [&](int level, const std::vector<Cube>& cubes) {
        Grid::Ptr grid = sampled(source, level, levels, voxel, cubes);
        if (!file.empty()) grids.push_back(grid);
        return grid;
      }).run();
  if (!file.empty()) write_levels(grids, key, file);
  return result;
}

bool has_levels(const std::string& file, std::size_t most_bytes, const GridKey& key) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return false;
  const auto size = std::filesystem::file_size(file, error);
  if (error || size < sizeof(Trailer) || size > most_bytes) return false;
  std::ifstream in(file, std::ios::binary);
  Trailer trailer{.key = key, .size = 0, .checksum = 0};
  in.seekg(static_cast<std::streamoff>(size - sizeof trailer));
  in.read(reinterpret_cast<char*>(&trailer), sizeof trailer);
  return in && fits(trailer, key, size);
}

std::optional<DistanceLevels> read_levels(const std::string& file, float voxel,
                                          std::size_t most_bytes, const GridKey& key) {
  initialize();
  try {
    if (auto bytes = grids_in(file, most_bytes, key))
      return levels_from(std::move(*bytes), voxel, most_bytes);
  } catch (const Cancelled&) {
    throw;
  } catch (const GridTooLarge&) {
  } catch (const Damaged&) {
  } catch (const std::exception&) {  // of OpenVDB, or of memory
  }
  return std::nullopt;
}

}  // namespace penumbra::sdf
