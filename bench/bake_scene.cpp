#include "bake_scene.h"

#include <cmath>
#include <numbers>
#include <random>

namespace penumbra::bench {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

void add_mesh(Scene& scene, Mesh mesh) {
  Instance instance;
  instance.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back(instance);
}

void append_quad(Mesh& mesh, const Vec3& corner, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vec3& p : {corner, corner + u, corner + u + v, corner + v})
    mesh.positions.push_back(p);
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + i);
}

Mesh quad(const Vec3& corner, const Vec3& u, const Vec3& v) {
  Mesh mesh;
  append_quad(mesh, corner, u, v);
  return mesh;
}

Mesh box(const Vec3& lo, const Vec3& size) {
  const Vec3 x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z}, hi = lo + size;
  Mesh mesh;
  append_quad(mesh, lo, x, z), append_quad(mesh, lo, z, y), append_quad(mesh, lo, y, x);
  append_quad(mesh, hi, -z, -x), append_quad(mesh, hi, -y, -z), append_quad(mesh, hi, -x, -y);
  return mesh;
}

Mesh ball(const Vec3& center, float radius, int rings, int sectors) {
  Mesh mesh;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s <= sectors; ++s) {
      // The seam and the poles are closed to the last bit.
      const float t = pi * static_cast<float>(r) / static_cast<float>(rings);
      const float p = 2 * pi * static_cast<float>(s % sectors) / static_cast<float>(sectors);
      const float away = r == 0 || r == rings ? 0 : std::sin(t);
      mesh.positions.push_back(center +
                               Vec3{away * std::cos(p), std::cos(t), away * std::sin(p)} * radius);
    }
  const auto at = [&](int r, int s) { return static_cast<std::uint32_t>(r * (sectors + 1) + s); };
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < sectors; ++s) {
      if (r > 0)
        for (const std::uint32_t i : {at(r, s), at(r, s + 1), at(r + 1, s)})
          mesh.indices.push_back(i);
      if (r + 1 < rings)
        for (const std::uint32_t i : {at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)})
          mesh.indices.push_back(i);
    }
  return mesh;
}

/// Cuts the mesh off after so many triangles.
Mesh first_triangles(Mesh mesh, std::size_t count) {
  mesh.indices.resize(std::min(mesh.indices.size(), 3 * count));
  return mesh;
}

std::size_t triangles_of(const Scene& scene) {
  std::size_t n = 0;
  for (const Mesh& m : scene.meshes) n += m.triangle_count();
  return n;
}

void add_rect_light(Scene& scene, const Vec3& at, float width, float depth) {
  Light light;
  light.type = LightType::rect;
  light.position = at;
  light.normal = {0, -1, 0};
  light.edge_u = {width, 0, 0}, light.edge_v = {0, 0, depth};
  light.emission = {12, 11, 9};
  scene.lights.push_back(light);
}

/// The chart of a quad that begins at corner `first` of an instance's mesh.
bake::PlanarChart chart_of(const Scene& scene, std::uint32_t instance, std::uint32_t first,
                           float texel_size) {
  const Mesh& mesh = scene.meshes[scene.instances[instance].mesh];
  bake::PlanarChart chart;
  chart.instance = instance;
  chart.triangles = {first / 2, first / 2 + 1};
  chart.base = mesh.positions[first];
  chart.edge_x = mesh.positions[first + 1] - chart.base;
  chart.edge_y = mesh.positions[first + 3] - chart.base;
  chart.normal = normalize(cross(chart.edge_x, chart.edge_y));
  const auto texels = [&](const Vec3& edge) {
    return std::max(1, static_cast<int>(std::lround(length(edge) / texel_size)));
  };
  chart.width = texels(chart.edge_x), chart.height = texels(chart.edge_y);
  return chart;
}

constexpr float side = 4, high = 3;

/// Floor and two walls as instances 0 to 2, and the lights.
BakeScene empty_room(int texels, int samples) {
  BakeScene s;
  s.scene.materials.emplace_back();
  add_mesh(s.scene, quad({0, 0, side}, {side, 0, 0}, {0, 0, -side}));
  add_mesh(s.scene, quad({0, 0, 0}, {side, 0, 0}, {0, high, 0}));
  add_mesh(s.scene, quad({0, 0, side}, {0, 0, -side}, {0, high, 0}));
  add_rect_light(s.scene, {1.2f, 2.9f, 1.2f}, 0.6f, 0.6f);
  add_rect_light(s.scene, {2.9f, 2.9f, 2.5f}, 0.6f, 0.6f);
  const float area = side * side + 2 * side * high;
  const float texel = std::sqrt(area / static_cast<float>(texels));
  for (std::uint32_t i = 0; i < 3; ++i) s.charts.push_back(chart_of(s.scene, i, 0, texel));
  s.options.light_samples = samples;
  s.options.device = bake::BakeDevice::cpu;
  return s;
}

/// Balls on the floor and in the air, until there are enough.
void furnish(BakeScene& s, int polygons) {
  const auto wanted = static_cast<std::size_t>(polygons);
  const bool fine = polygons > 2000;
  const int rings = fine ? 16 : 7, sectors = fine ? 24 : 10;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(0.5f, 3.5f), height(0.3f, 1.8f), size(0.15f, 0.3f);
  s.movable = s.scene.meshes.size();
  while (triangles_of(s.scene) < wanted) {
    const float x = place(random), y = height(random), z = place(random);
    const std::size_t left = wanted - triangles_of(s.scene);
    add_mesh(s.scene, first_triangles(ball({x, y, z}, size(random), rings, sectors), left));
  }
}

}  // namespace

std::size_t BakeScene::triangle_count() const { return triangles_of(scene); }

std::size_t BakeScene::texel_count() const {
  std::size_t n = 0;
  for (const bake::PlanarChart& c : charts)
    n += static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height);
  return n;
}

BakeScene room(int polygons, int samples, int texels) {
  BakeScene s = empty_room(texels, samples);
  furnish(s, polygons);
  return s;
}

BakeScene room_with_table(int polygons, int texels) {
  BakeScene s = empty_room(texels, 49);
  const float texel = length(s.charts[0].edge_x) / static_cast<float>(s.charts[0].width);
  const auto top = static_cast<std::uint32_t>(s.scene.instances.size());
  add_mesh(s.scene, box({1.2f, 0.7f, 1.4f}, {1.6f, 0.06f, 1}));
  for (const Vec3& at :
       {Vec3{1.25f, 0, 1.45f}, Vec3{2.67f, 0, 1.45f}, Vec3{1.25f, 0, 2.27f}, Vec3{2.67f, 0, 2.27f}})
    add_mesh(s.scene, box(at, {0.08f, 0.7f, 0.08f}));
  s.options.instance_scale.assign(s.scene.instances.size(), 1);
  const auto add = [&](std::uint32_t instance, std::uint32_t face, float samples) {
    s.options.instance_scale[instance] = samples / 49;
    s.charts.push_back(chart_of(s.scene, instance, 4 * face, texel));
  };
  // Of the top all faces, of the legs the four sides: 3 + 6 + 16 receivers.
  for (std::uint32_t face = 0; face < 6; ++face) add(top, face, 9);
  for (std::uint32_t leg = 1; leg <= 4; ++leg)
    for (const std::uint32_t side_face : {1u, 2u, 4u, 5u}) add(top + leg, side_face, 4);
  furnish(s, polygons);
  s.options.instance_scale.resize(s.scene.instances.size(), 1);
  return s;
}

BakeScene boxes(int polygons, int samples, int texels) {
  BakeScene s = empty_room(texels, samples);
  s.charts.clear();
  // Boxes on a grid in the room, smaller the more there are: the share of space that they fill
  // stays.
  const int count = std::max(1, (polygons - 6) / 12);
  const int along = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(count))));
  const float cell = 2.6f / static_cast<float>(along);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> jitter(0.05f, 0.5f), size(0.25f, 0.45f);
  for (int i = 0; i < count; ++i) {
    const Vec3 at{static_cast<float>(i % along), static_cast<float>(i / along / along),
                  static_cast<float>(i / along % along)};
    const float jx = jitter(random), jy = jitter(random), jz = jitter(random);
    const float sx = size(random), sy = size(random), sz = size(random);
    add_mesh(s.scene, box(Vec3{0.6f, 0.02f, 0.6f} + (at + Vec3{jx, jy, jz}) * cell,
                          Vec3{sx, sy, sz} * cell));
  }
  const auto each_quad = [&](const auto& body) {
    for (std::uint32_t i = 0; i < s.scene.instances.size(); ++i) {
      const Mesh& mesh = s.scene.meshes[s.scene.instances[i].mesh];
      for (std::uint32_t first = 0; first < mesh.positions.size(); first += 4) body(i, first);
    }
  };
  double area = 0;
  each_quad([&](std::uint32_t i, std::uint32_t first) {
    const auto c = chart_of(s.scene, i, first, 1);
    area += static_cast<double>(length(c.edge_x) * length(c.edge_y));
  });
  const float texel = static_cast<float>(std::sqrt(area / texels));
  each_quad([&](std::uint32_t i, std::uint32_t first) {
    s.charts.push_back(chart_of(s.scene, i, first, texel));
  });
  return s;
}

}  // namespace penumbra::bench
