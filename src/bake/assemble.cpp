#include "bake/assemble.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace penumbra::bake {

GlbPrimitive& Assembly::primitive(std::uint32_t instance, int material) {
  GlbPrimitive& p = primitives_[{scene_.instances[instance].object, material}];
  p.material = material;
  return p;
}

/// Calls append(triangle, corner) for each vertex that is new; vertices are shared in this call
/// alone, since every chart has coordinates of its own.
template <class Append>
void Assembly::add_triangles(const WorldMesh& mesh, std::span<const std::uint32_t> triangles,
                             bool back, GlbPrimitive& out, const Append& append) {
  std::unordered_map<std::uint32_t, std::uint32_t> places;
  for (const std::uint32_t t : triangles)
    for (int k = 0; k < 3; ++k) {
      const int corner = back ? 2 - k : k;
      const auto [it, is_new] = places.try_emplace(
          mesh.vertex(t, corner), static_cast<std::uint32_t>(out.positions.size()));
      if (is_new) {
        out.positions.push_back(mesh.corner(t, corner));
        append(t, corner);
      }
      out.indices.push_back(it->second);
    }
}

/// Normals and the mesh's own texture coordinates; channels that only some meshes have are filled.
void Assembly::append_shading(const WorldMesh& mesh, std::uint32_t triangle, int corner, bool back,
                              GlbPrimitive& out) const {
  out.normals.push_back(mesh.corner_normal(triangle, corner) * (back ? -1.0f : 1.0f));
  const std::uint32_t v = mesh.vertex(triangle, corner);
  const auto uv = [&](int set) {
    const std::vector<Vec2>& all = mesh.mesh().uv[set];
    return all.empty() ? Vec2{} : all[v];
  };
  out.uv[0].push_back(uv(0));
  out.uv[2].push_back(uv(1));
  out.colors.push_back(mesh.mesh().colors.empty() ? Vec3(1.0f) : mesh.mesh().colors[v]);
}

void Assembly::add_textured(const CutChart& chart, const ChartPlace& place, const AtlasPage& page,
                            int material, bool keep_shading) {
  const PlanarChart& shape = chart.shape;
  const WorldMesh& mesh = *plan_.meshes[shape.instance];
  const ChartFrame frame(shape);
  GlbPrimitive& out = primitive(shape.instance, material);
  out.uv.resize(keep_shading ? 3 : 1);
  add_triangles(mesh, shape.triangles, shape.back, out, [&](std::uint32_t t, int k) {
    const std::uint32_t vertex = mesh.vertex(t, k);
    std::vector<Vec2>& uv = out.uv[keep_shading ? 1 : 0];
    if (shape.uv) {
      const Vec2 &own = mesh.mesh().uv[shape.uv->set][vertex], &tile = shape.uv->tile;
      uv.push_back({own.x - tile.x, own.y - tile.y});
    } else {
      const Vec2 at = place.in_page(frame.texels(mesh, vertex));
      uv.push_back({at.x / static_cast<float>(page.width), at.y / static_cast<float>(page.height)});
    }
    if (keep_shading) append_shading(mesh, t, k, shape.back, out);
  });
}

void Assembly::add_colored(const CutChart& chart, const std::vector<VertexColor>& colors,
                           float scale, int material) {
  const PlanarChart& shape = chart.shape;
  const WorldMesh& mesh = *plan_.meshes[shape.instance];
  GlbPrimitive& out = primitive(shape.instance, material);
  add_triangles(mesh, shape.triangles, shape.back, out, [&](std::uint32_t t, int k) {
    const std::uint32_t vertex = mesh.vertex(t, k);
    out.colors.push_back(std::ranges::lower_bound(colors, vertex, {}, &VertexColor::vertex)->color *
                         scale);
  });
}

void Assembly::add_plain(std::uint32_t instance, bool back, const std::vector<Vec3>& colors,
                         int material, bool keep_shading) {
  const WorldMesh& mesh = *plan_.meshes[instance];
  GlbPrimitive& out = primitive(instance, material);
  out.uv.resize(keep_shading ? 3 : 0);
  std::vector<std::uint32_t> all(mesh.triangle_count());
  std::iota(all.begin(), all.end(), 0u);
  add_triangles(mesh, all, back, out, [&](std::uint32_t t, int k) {
    if (!colors.empty()) out.colors.push_back(colors[mesh.vertex(t, k)]);
    if (!keep_shading) return;
    append_shading(mesh, t, k, back, out);
    out.uv[1].push_back({});
  });
}

namespace {

/// Channels that only some meshes have, where none of a primitive's did.
void drop_empty_channels(GlbPrimitive& p) {
  const auto is_zero = [](const Vec2& v) { return v.x == 0 && v.y == 0; };
  if (p.uv.size() == 3 && std::ranges::all_of(p.uv[2], is_zero)) p.uv.pop_back();
  if (std::ranges::all_of(p.colors, [](const Vec3& c) { return c == Vec3(1.0f); }))
    p.colors.clear();
}

}  // namespace

std::vector<GlbNode> Assembly::take() {
  std::vector<GlbNode> nodes;
  std::uint32_t last = 0xffffffffu;
  for (auto& [key, primitive] : primitives_) {
    if (key.first != last) nodes.push_back({scene_.objects[key.first].name, {}});
    last = key.first;
    parts_.push_back({nodes.back().name, nodes.back().primitives.size(), key.second});
    drop_empty_channels(primitive);
    nodes.back().primitives.push_back(std::move(primitive));
  }
  return nodes;
}

}  // namespace penumbra::bake
