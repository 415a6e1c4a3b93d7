#include "sdf/regions.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "base/parallel.h"

namespace penumbra::sdf {
namespace {

constexpr int side = Regions::brick_side;
constexpr int brick_cells = side * side * side;
constexpr std::size_t short_enough = 8;  ///< words: a cell with no more is not cut further
/// Bytes for each word of the whole code: small fields are not worth long preparation.
constexpr std::size_t bytes_per_word = 20000;
constexpr int most_levels = 2;  ///< of bricks
/// Words: where there are runs, the whole code leaves out more than such a code does.
constexpr std::size_t long_code = 64;

/// Codes found so far, each once.
class CodeStore {
 public:
  CodeStore(Regions& regions, const Tape& tape) : regions_(regions) {
    std::size_t unused = 0;
    add(tape.code, unused);
    has_runs_ = !tape.runs.empty();
  }

  /// `used` grows by the bytes that the code takes if it is new.
  std::uint32_t add(const std::vector<Word>& code, std::size_t& used) {
    if (has_runs_ && code.size() > long_code) return 0;
    std::size_t hash = code.size();
    for (const Word w : code) hash = (hash ^ w) * 0x9e3779b97f4a7c15ull, hash ^= hash >> 29;
    const std::lock_guard lock(mutex_);
    auto& list = by_hash_[hash];
    for (const std::uint32_t known : list) {
      const Regions::Code& c = regions_.codes[known];
      if (c.count == code.size() &&
          std::equal(code.begin(), code.end(), regions_.words.begin() + c.begin))
        return known;
    }
    const auto number = static_cast<std::uint32_t>(regions_.codes.size());
    regions_.codes.push_back({static_cast<std::uint32_t>(regions_.words.size()),
                              static_cast<std::uint32_t>(code.size())});
    regions_.words.insert(regions_.words.end(), code.begin(), code.end());
    list.push_back(number);
    used += code.size() * sizeof(Word) + sizeof(Regions::Code) + 64;
    return number;
  }

  std::uint32_t add_brick(const std::uint32_t* cells) {
    const std::lock_guard lock(mutex_);
    const auto first = static_cast<std::uint32_t>(regions_.cells.size());
    regions_.cells.insert(regions_.cells.end(), cells, cells + brick_cells);
    return first | Regions::brick_bit;
  }

 private:
  Regions& regions_;
  bool has_runs_ = false;
  std::mutex mutex_;
  std::unordered_map<std::size_t, std::vector<std::uint32_t>> by_hash_;
};

/// Cells of a grid from `lo` up to `hi`, exclusive.
struct Block {
  int lo[3], hi[3];
  bool is_cell() const { return hi[0] - lo[0] == 1 && hi[1] - lo[1] == 1 && hi[2] - lo[2] == 1; }
};

std::vector<Block> split(const Block& block) {
  int parts[3];
  for (int i = 0; i < 3; ++i) parts[i] = std::min(side, block.hi[i] - block.lo[i]);
  std::vector<Block> blocks;
  for (int z = 0; z < parts[2]; ++z)
    for (int y = 0; y < parts[1]; ++y)
      for (int x = 0; x < parts[0]; ++x) {
        const int at[3] = {x, y, z};
        Block part;
        for (int i = 0; i < 3; ++i) {
          const int length = block.hi[i] - block.lo[i];
          part.lo[i] = block.lo[i] + length * at[i] / parts[i];
          part.hi[i] = block.lo[i] + length * (at[i] + 1) / parts[i];
        }
        blocks.push_back(part);
      }
  return blocks;
}

struct Cube {
  Vec3 center;
  float radius;
};

class Builder {
 public:
  /// top: the entries of both grids, apart from the list that grows.
  Builder(const Tape& tape, CodeStore& store, std::vector<std::uint32_t>& top)
      : tape_(tape), store_(store), top_(top) {}

  /// quota: bytes for codes and bricks, shared evenly so that no part of space goes without.
  void fill(const RegionGrid& grid, std::size_t quota) {
    const Block whole{{0, 0, 0}, {grid.count[0], grid.count[1], grid.count[2]}};
    std::vector<Block> blocks = split(whole);
    std::vector<std::vector<Word>> codes = prune_all(tape_.code, cubes_of(grid, blocks));
    parallel_for(blocks.size(),
                 [&](std::size_t i) { fill(grid, blocks[i], codes[i], quota / blocks.size()); });
  }

 private:
  std::vector<Cube> cubes_of(const RegionGrid& grid, const std::vector<Block>& blocks) const {
    std::vector<Cube> cubes;
    for (const Block& b : blocks) {
      Vec3 half;
      Cube cube;
      for (int i = 0; i < 3; ++i) {
        half[i] = 0.5f * grid.size * static_cast<float>(b.hi[i] - b.lo[i]);
        cube.center[i] = grid.lo[i] + grid.size * static_cast<float>(b.lo[i]) + half[i];
      }
      cube.radius = length(half);
      cubes.push_back(cube);
    }
    return cubes;
  }

  std::vector<std::vector<Word>> prune_all(const std::vector<Word>& code,
                                           const std::vector<Cube>& cubes) const {
    std::vector<std::vector<Word>> codes(cubes.size());
    std::vector<Ranges> ranges;
    for (std::size_t first = 0; first < cubes.size(); first += 16) {
      Cells cells;
      for (std::size_t l = 0; l < 16; ++l) {
        const Cube& cube = cubes[std::min(first + l, cubes.size() - 1)];
        cells.x[l] = cube.center.x, cells.y[l] = cube.center.y, cells.z[l] = cube.center.z;
        cells.radius[l] = cube.radius * 1.001f;
      }
      ranges_in(tape_, code, cells, ranges);
      for (std::size_t l = 0; l < 16 && first + l < cubes.size(); ++l)
        prune(tape_, code, ranges, static_cast<int>(l), codes[first + l]);
    }
    return codes;
  }

  // Gives the bytes used.
  std::size_t fill(const RegionGrid& grid, const Block& block, const std::vector<Word>& code,
                   std::size_t quota) {
    std::size_t used = 0;
    if (block.is_cell()) {
      const Cube cube = cubes_of(grid, {block}).front();
      fill_with(grid, block, refined(cube.center, grid.size, code, 0, quota, used));
      return used;
    }
    if (code.size() <= 1 || quota < worth_of(code)) {
      fill_with(grid, block, store_.add(code, used));
      return used;
    }
    const std::vector<Block> parts = split(block);
    const auto codes = prune_all(code, cubes_of(grid, parts));
    for (std::size_t i = 0; i < parts.size(); ++i)
      used += fill(grid, parts[i], is_worth_keeping(codes[i], code) ? codes[i] : code,
                   share(quota, used, parts.size() - i));
    return used;
  }

  static std::size_t share(std::size_t quota, std::size_t used, std::size_t left) {
    return used < quota ? (quota - used) / left : 0;
  }
  // What it takes to cut a cell of this code into parts of their own, about.
  static std::size_t worth_of(const std::vector<Word>& code) { return 256 + 32 * code.size(); }

  // Long codes that are hardly shorter than the one around them would only cost memory.
  static bool is_worth_keeping(const std::vector<Word>& part, const std::vector<Word>& whole) {
    return whole.size() < 16 || part.size() * 10 < whole.size() * 9;
  }

  void fill_with(const RegionGrid& grid, const Block& b, std::uint32_t entry) {
    for (int z = b.lo[2]; z < b.hi[2]; ++z)
      for (int y = b.lo[1]; y < b.hi[1]; ++y)
        for (int x = b.lo[0]; x < b.hi[0]; ++x)
          top_[grid.first +
               static_cast<std::uint32_t>(x + grid.count[0] * (y + grid.count[1] * z))] = entry;
  }

  // The entry of a cell: its code, or a brick where smaller cells have shorter ones.
  std::uint32_t refined(const Vec3& center, float size, const std::vector<Word>& code, int level,
                        std::size_t quota, std::size_t& used) {
    if (code.size() <= short_enough || level == most_levels || quota < worth_of(code))
      return store_.add(code, used);
    const float part = size / side;
    std::vector<Cube> cubes;
    for (int i = 0; i < brick_cells; ++i) {
      const int x = i % side, y = i / side % side, z = i / (side * side);
      const Vec3 at(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
      cubes.push_back(
          {center + (at - Vec3(0.5f * (side - 1))) * part, 0.5f * part * std::sqrt(3.0f)});
    }
    const auto codes = prune_all(code, cubes);
    if (std::ranges::all_of(codes, [&](const auto& c) { return c.size() == code.size(); }))
      return store_.add(code, used);
    std::size_t mine = brick_cells * sizeof(std::uint32_t);
    std::uint32_t entries[brick_cells];
    for (std::size_t i = 0; i < brick_cells; ++i)
      entries[i] =
          refined(cubes[i].center, part, is_worth_keeping(codes[i], code) ? codes[i] : code,
                  level + 1, share(quota, mine, brick_cells - i), mine);
    used += mine;
    return store_.add_brick(entries);
  }

  const Tape& tape_;
  CodeStore& store_;
  std::vector<std::uint32_t>& top_;
};

RegionGrid grid_over(const Bounds& box, double cells, std::uint32_t first) {
  RegionGrid grid;
  const Vec3d size(box.size());
  double edge = std::cbrt(size.x * size.y * size.z / cells);
  edge = std::max(edge, max_component(size) / 128);
  grid.lo = box.lo;
  grid.size = static_cast<float>(edge);
  grid.inverse = 1 / grid.size;
  for (int i = 0; i < 3; ++i)
    grid.count[i] = std::clamp(static_cast<int>(std::ceil(size[i] / edge)), 1, 128);
  grid.first = first;
  return grid;
}

std::uint32_t cell_count(const RegionGrid& grid) {
  return static_cast<std::uint32_t>(grid.count[0] * grid.count[1] * grid.count[2]);
}

}  // namespace

Regions build_regions(const Tape& tape, const Bounds& inner, const Bounds& outer,
                      const RegionLimits& limits) {
  Regions regions;
  CodeStore store(regions, tape);
  regions.cells = {0};
  if (!limits.enabled || tape.code.size() <= 1) return regions;
  const double cells = std::clamp(100.0 * static_cast<double>(tape.code.size()), 2e3, 6e4);
  regions.inner = grid_over(inner, cells, 1);
  regions.outer = grid_over(outer, cells / 2, 1 + cell_count(regions.inner));
  const std::uint32_t top = regions.outer.first + cell_count(regions.outer);
  regions.cells.resize(top);
  std::vector<std::uint32_t> entries(top, 0);
  Builder builder(tape, store, entries);
  const std::size_t quota = std::min(limits.bytes, tape.code.size() * bytes_per_word);
  builder.fill(regions.inner, quota / 4 * 3);
  builder.fill(regions.outer, quota / 4);
  std::ranges::copy(entries, regions.cells.begin());
  regions.cells.shrink_to_fit(), regions.words.shrink_to_fit(), regions.codes.shrink_to_fit();
  return regions;
}

std::uint32_t region_of(const Regions& regions, const Vec3& p) {
  for (const RegionGrid* grid : {&regions.inner, &regions.outer}) {
    const Vec3 at = (p - grid->lo) * grid->inverse;
    bool inside = true;
    for (int i = 0; i < 3; ++i)
      inside = inside && at[i] >= 0 && at[i] < static_cast<float>(grid->count[i]);
    if (!inside) continue;
    Vec3 cell(std::floor(at.x), std::floor(at.y), std::floor(at.z));
    std::uint32_t entry =
        regions
            .cells[grid->first + static_cast<std::uint32_t>(
                                     static_cast<int>(cell.x) +
                                     grid->count[0] * (static_cast<int>(cell.y) +
                                                       grid->count[1] * static_cast<int>(cell.z)))];
    Vec3 rest = at - cell;
    while (entry & Regions::brick_bit) {
      rest *= static_cast<float>(side);
      int index[3];
      for (int i = 0; i < 3; ++i) {
        index[i] = std::min(static_cast<int>(rest[i]), side - 1);
        rest[i] -= static_cast<float>(index[i]);
      }
      entry =
          regions.cells[(entry & ~Regions::brick_bit) +
                        static_cast<std::uint32_t>(index[0] + side * (index[1] + side * index[2]))];
    }
    return entry;
  }
  return 0;
}

}  // namespace penumbra::sdf
