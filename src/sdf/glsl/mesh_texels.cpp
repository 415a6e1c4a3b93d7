#include "sdf/glsl/mesh_texels.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "sdf/distance_levels.h"
#include "sdf/triangle_tree.h"

namespace penumbra::sdf {
namespace {

constexpr int corners = DistanceLevels::corners, brick_values = DistanceLevels::brick_values;
/// Nearer to the surface the shader asks for a corner's winding number: less than four voxels for
/// the mean of a cell's corners, which are up to a diagonal apart.
constexpr float asked_within = 6;

// pnb_winding_in undoes it.
float with_code(float d, float winding) {
  const float code = std::clamp(std::round((winding + 1) * 16), 0.0f, 63.0f);
  return std::bit_cast<float>((std::bit_cast<std::uint32_t>(d) & ~63u) |
                              static_cast<std::uint32_t>(code));
}

/// The finest bricks and where they begin, in voxels.
struct FineBrick {
  std::size_t number;
  Vec3 low;
};

std::vector<FineBrick> fine_bricks(const DistanceLevels& levels) {
  struct Cube {
    std::int32_t node;
    int level;
    Vec3 low;
  };
  const auto half = static_cast<float>(DistanceLevels::cells / 2 << (levels.levels - 1));
  std::vector<Cube> cubes{{0, levels.levels - 1, Vec3(-half)}};
  std::vector<FineBrick> bricks;
  while (!cubes.empty()) {
    const Cube cube = cubes.back();
    cubes.pop_back();
    const std::int32_t first = levels.nodes[static_cast<std::size_t>(cube.node)];
    if (first < 0 && cube.level == 0)
      bricks.push_back({static_cast<std::size_t>(~first), cube.low});
    if (first < 0) continue;
    const auto side = static_cast<float>(DistanceLevels::cells << (cube.level - 1));
    for (std::int32_t i = 0; i < 8; ++i)
      cubes.push_back({first + i, cube.level - 1,
                       cube.low + Vec3(static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1),
                                       static_cast<float>(i >> 2)) *
                                      side});
  }
  return bricks;
}

void add_windings(const DistanceLevels& levels, const TriangleTree& triangles,
                  const FineBrick& brick, std::vector<float>& values) {
  const std::size_t first = brick.number * brick_values;
  for (int i = 0; i < brick_values; ++i) {
    const float d = levels.values[first + static_cast<std::size_t>(i)];
    float winding = d < 0 ? 1.0f : 0.0f;
    if (const auto whole = winding_in(d)) {
      winding = static_cast<float>(*whole);
    } else if (std::abs(d) < asked_within * levels.voxel) {
      const int x = i % corners, y = i / corners % corners, z = i / (corners * corners);
      const Vec3 corner(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
      winding = triangles.winding((brick.low + corner) * levels.voxel);
    }
    values[first + static_cast<std::size_t>(i)] = with_code(d, winding);
  }
}

std::vector<float> values_of(const DistanceLevels& levels, const TriangleTree& triangles) {
  std::vector<float> values(levels.values.size());
  std::ranges::transform(levels.values, values.begin(),
                         [](float d) { return with_code(d, d < 0 ? 1.0f : 0.0f); });
  const std::vector<FineBrick> bricks = fine_bricks(levels);
  parallel_for(bricks.size(),
               [&](std::size_t i) { add_windings(levels, triangles, bricks[i], values); });
  return values;
}

/// Nodes about the middle, so that a shader need not come down from the root: most of what it asks
/// for is near the mesh, and the root is 64 times as wide.
struct Table {
  int depth, side;
  std::vector<float> pairs;  ///< node, bits of its cells' numbers
};

Table table_of(const DistanceLevels& levels) {
  const int deepest = std::min(levels.levels - 1, 9);
  Table table{deepest < 6 ? 0 : deepest, deepest < 6 ? 1 : 1 << (deepest - 5), {}};
  const int first = ((1 << table.depth) - table.side) / 2;
  for (int i = 0; i < table.side * table.side * table.side; ++i) {
    const int at[3] = {first + i % table.side, first + i / table.side % table.side,
                       first + i / (table.side * table.side)};
    std::int32_t node = levels.nodes[0];
    int step = 0;
    while (node >= 0 && step < table.depth) {
      const int bit = table.depth - ++step;
      const int octant = (at[0] >> bit & 1) | (at[1] >> bit & 1) << 1 | (at[2] >> bit & 1) << 2;
      node = levels.nodes[static_cast<std::size_t>(node + octant)];
    }
    table.pairs.push_back(static_cast<float>(node));
    table.pairs.push_back(static_cast<float>(levels.levels + 2 - step));
  }
  return table;
}

void add_rows(const Affine& m, std::array<double, 3> behind, std::vector<float>& texels) {
  const Vec3d* column[3] = {&m.x, &m.y, &m.z};
  for (int row = 0; row < 3; ++row) {
    for (const Vec3d* c : column) texels.push_back(static_cast<float>((*c)[row]));
    texels.push_back(static_cast<float>(behind[static_cast<std::size_t>(row)]));
  }
}

void add_map(const Affine& m, std::vector<float>& texels) {
  add_rows(m, {m.t.x, m.t.y, m.t.z}, texels);
}

/// Three numbers of vertices a triangle, in the order of the grid's.
std::vector<float> corners_of(const Mesh& mesh, bool turned_round) {
  std::vector<float> numbers;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const std::uint32_t b = mesh.indices[i + 1], c = mesh.indices[i + 2];
    numbers.insert(numbers.end(),
                   {static_cast<float>(mesh.indices[i]), static_cast<float>(turned_round ? c : b),
                    static_cast<float>(turned_round ? b : c), 0.0f});
  }
  return numbers;
}

/// Normals, and behind each the texture coordinates if there are any.
std::vector<float> vertices_of(const Mesh& mesh) {
  const bool has_uv = !mesh.uv[0].empty() || !mesh.uv[1].empty();
  std::vector<float> vertices;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 n = mesh.normals.empty() ? Vec3() : mesh.normals[i];
    vertices.insert(vertices.end(), {n.x, n.y, n.z, 0.0f});
    if (!has_uv) continue;
    for (const auto& uv : mesh.uv) {
      const Vec2 at = uv.empty() ? Vec2{} : uv[i];
      vertices.insert(vertices.end(), {at.x, at.y});
    }
  }
  return vertices;
}

}  // namespace

float MeshTexels::append(const std::vector<float>& numbers) {
  texels_.resize((texels_.size() + 15) / 16 * 16);
  const std::size_t first = texels_.size() / 4;
  texels_.insert(texels_.end(), numbers.begin(), numbers.end());
  texels_.resize((texels_.size() + 3) / 4 * 4);
  return static_cast<float>(first);
}

void MeshTexels::write_mesh(const TriangleTree& tree, const Mesh& mesh, bool turned_round,
                            GridRecord& r) {
  std::vector<float> boxes, triangles;
  tree.write_texels(boxes, triangles);
  const std::size_t box_count = boxes.size() / 8;
  r[5] = append(boxes), r[6] = static_cast<float>(box_count);
  r[7] = append(triangles);
  r[12] = append(corners_of(mesh, turned_round)), r[13] = append(vertices_of(mesh));
  r[14] = mesh.uv[0].empty() && mesh.uv[1].empty() ? 1.0f : 2.0f;
  r[15] = mesh.normals.empty() ? 0.0f : 1.0f;
}

MeshTexels::GridRecord MeshTexels::write(const MeshGrid& grid, const Mesh& mesh,
                                         bool turned_round) {
  const DistanceLevels& levels = grid.levels();
  const Table table = table_of(levels);
  GridRecord r{};
  r[0] = append({levels.nodes.begin(), levels.nodes.end()});
  r[1] = append(values_of(levels, grid.triangles()));
  r[2] = append(table.pairs);
  r[3] = static_cast<float>(table.depth), r[4] = static_cast<float>(table.side);
  r[8] = static_cast<float>(levels.levels), r[9] = levels.voxel;
  r[10] = grid.frame().ball_radius, r[11] = grid.is_closed() ? 0.5f : 0.6f;
  write_mesh(grid.triangles(), mesh, turned_round, r);
  return r;
}

void MeshTexels::add_record(const Instance& instance, std::size_t number, const Affine& from_world,
                            double scale, const GridRecord& grid) {
  add_map(from_world, records_);
  add_map(inverse(from_world), records_);
  // The cofactor matrix of a mirroring turns normals round; turn them back.
  const Affine& m = instance.world_from_mesh;
  const double side = m.determinant() < 0 ? -1 : 1;
  add_rows({cross(m.y, m.z) * side, cross(m.z, m.x) * side, cross(m.x, m.y) * side, {}},
           {scale, double(instance.material), instance.mesh_light < 0 ? -1.0 : double(number)},
           records_);
  records_.insert(records_.end(), grid.begin(), grid.end());
  const Vec3 center(inverse(from_world).t);
  const bool has_formula = grid[8] == 0;
  records_.insert(records_.end(), {center.x, center.y, center.z,
                                   static_cast<float>(scale) * (has_formula ? -1 : 1) * grid[10]});
}

void MeshTexels::add(const Scene& scene, std::size_t number, const MeshDistance::Placed& placed) {
  const Instance& instance = scene.instances[number];
  const Affine& world_from_mesh = instance.world_from_mesh;
  auto [at, is_new] = written_.try_emplace(placed.grid);
  if (is_new)
    at->second = write(*placed.grid, scene.meshes[instance.mesh],
                       world_from_mesh.determinant() < 0 && !is_similarity(world_from_mesh));
  const MeshGrid::Frame frame = placed.grid->frame();
  const double unit = 1 / frame.side;
  const Affine to_unit{{unit, 0, 0}, {0, unit, 0}, {0, 0, unit}, frame.center * -unit};
  add_record(instance, number, to_unit * placed.grid_from_world, placed.scale * frame.side,
             at->second);
}

void MeshTexels::add_triangles(const Scene& scene, std::size_t number) {
  const Instance& instance = scene.instances[number];
  const Mesh& mesh = scene.meshes[instance.mesh];
  GridRecord r{};
  for (const Vec3& p : mesh.positions) r[10] = std::max(r[10], length(p));
  write_mesh(TriangleTree(mesh.positions, mesh.indices), mesh, false, r);
  add_record(instance, number, inverse(instance.world_from_mesh),
             length(instance.world_from_mesh.x), r);
}

int MeshTexels::finish() {
  const std::size_t count = records_.size() / std::size_t{14 * 4};
  std::vector<float> all{static_cast<float>(count), 0, 0, 0};
  all.insert(all.end(), records_.begin(), records_.end());
  return static_cast<int>(append(all));
}

}  // namespace penumbra::sdf
