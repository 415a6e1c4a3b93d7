// What a hit means for shading: World::surface.
#include <algorithm>

#include "geometry/world.h"

namespace penumbra {
namespace {

struct Corner {
  Vec3 position, normal;
  Vec2 uv[2];
};

Surface sphere_surface(const Scene& scene, const Ray& ray, const Hit& hit, std::size_t index) {
  const Sphere& sphere = scene.spheres[index];
  Surface s;
  const Vec3 outward = normalize(ray.origin + ray.direction * hit.t - sphere.center);
  // Back onto the sphere: the ray's t carries the error of its whole length.
  s.position = sphere.center + outward * sphere.radius;
  s.front = dot(outward, ray.direction) < 0;
  s.normal = s.front ? outward : -outward;
  s.shading_normal = s.normal;
  s.smooth_position = s.position;
  s.material = sphere.material;
  s.object = sphere.object;
  s.primitive = hit.primitive;
  return s;
}

// Hanika 2021, Hacking the Shadow Terminator, section 4.3: the point is lifted to the planes
// through the vertices along their normals, weighted; never pushed below the facet.
Vec3 lifted(const Corner* corners, const float* weights, const Vec3& p, float side) {
  Vec3 lift;
  for (int i = 0; i < 3; ++i) {
    const Vec3 n = corners[i].normal * side;
    lift += n * (weights[i] * -std::min(0.0f, dot(p - corners[i].position, n)));
  }
  return p + lift;
}

float uv_per_metre(const Corner* c, int set, float world_area) {
  const Vec2 &a = c[0].uv[set], &b = c[1].uv[set], &d = c[2].uv[set];
  const float area = std::abs((b.x - a.x) * (d.y - a.y) - (b.y - a.y) * (d.x - a.x));
  return world_area > 0 ? std::sqrt(area / world_area) : 0.0f;
}

Vec2 mix(const Corner* c, const float* w, int set) {
  return {w[0] * c[0].uv[set].x + w[1] * c[1].uv[set].x + w[2] * c[2].uv[set].x,
          w[0] * c[0].uv[set].y + w[1] * c[1].uv[set].y + w[2] * c[2].uv[set].y};
}

Vec3 mixed_color(const Mesh& mesh, const Hit& hit, const float* weights) {
  const std::uint32_t* v = &mesh.indices[std::size_t{3} * hit.primitive.triangle];
  return mesh.colors[v[0]] * weights[0] + mesh.colors[v[1]] * weights[1] +
         mesh.colors[v[2]] * weights[2];
}

void load_corners(const Scene& scene, const Instance& instance, const std::uint32_t* v,
                  Corner* corners) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  const bool moved = !instance.world_from_mesh.is_identity();
  for (int i = 0; i < 3; ++i) {
    corners[i].position = mesh.positions[v[i]];
    if (!mesh.normals.empty()) corners[i].normal = mesh.normals[v[i]];
    for (int set = 0; set < 2; ++set)
      if (!mesh.uv[set].empty()) corners[i].uv[set] = mesh.uv[set][v[i]];
    if (!moved) continue;
    corners[i].position = instance.world_from_mesh.point(corners[i].position);
    // The cofactor matrix of a mirroring turns normals round; turn them back.
    const Vec3d n = instance.world_from_mesh.normal(Vec3d(corners[i].normal)) *
                    std::copysign(1.0, instance.world_from_mesh.determinant());
    if (dot(n, n) > 0) corners[i].normal = Vec3(normalize(n));
  }
}

void shade_smoothly(Surface& s, const Corner* corners, const float* weights) {
  // A vertex normal belongs to the side that the winding calls the front.
  const float side = s.front ? 1.0f : -1.0f;
  Vec3 n;
  for (int i = 0; i < 3; ++i) n += corners[i].normal * (weights[i] * side);
  const float len = length(n);
  // Below a third the vertex normals contradict one another or the facet: no smooth surface.
  if (!(len > 0.33f) || dot(n, s.normal) < 0.33f * len) return;
  s.shading_normal = n / len;
  s.smooth_position = lifted(corners, weights, s.position, side);
  s.smooth = true;
}

}  // namespace

Surface World::surface(const Ray& ray, const Hit& hit) const {
  const std::size_t meshes = scene_.instances.size();
  if (is_solid(hit)) {
    Surface solid;
    const std::uint32_t first = 0;
    solid_surfaces({&ray, 1}, {&hit, 1}, {&first, 1}, {&solid, 1});
    return solid;
  }
  if (hit.primitive.instance >= meshes)
    return sphere_surface(scene_, ray, hit, hit.primitive.instance - meshes);
  const Instance& instance = scene_.instances[hit.primitive.instance];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  Corner corners[3];
  load_corners(scene_, instance, &mesh.indices[std::size_t{3} * hit.primitive.triangle], corners);
  const float weights[] = {1 - hit.b1 - hit.b2, hit.b1, hit.b2};
  Surface s;
  for (int i = 0; i < 3; ++i) s.position += corners[i].position * weights[i];
  const Vec3 facet =
      cross(corners[1].position - corners[0].position, corners[2].position - corners[0].position);
  const float area = length(facet);
  const float winding = instance.world_from_mesh.determinant() < 0 ? -1.0f : 1.0f;
  s.front = winding * dot(facet, ray.direction) < 0;
  s.normal = area > 0 ? facet / area : -ray.direction;
  if (dot(s.normal, ray.direction) > 0) s.normal = -s.normal;
  s.shading_normal = s.normal;
  s.smooth_position = s.position;
  if (!mesh.normals.empty()) shade_smoothly(s, corners, weights);
  float* per_metre[] = {&s.uv_per_metre.x, &s.uv_per_metre.y};
  for (int set = 0; set < 2; ++set) {
    if (mesh.uv[set].empty()) continue;
    s.uv[set] = mix(corners, weights, set);
    *per_metre[set] = uv_per_metre(corners, set, area);
  }
  if (!mesh.colors.empty()) s.color = mixed_color(mesh, hit, weights);
  s.material = instance.material;
  s.object = instance.object;
  s.primitive = hit.primitive;
  return s;
}

void World::surfaces(std::span<const Ray> rays, std::span<const Hit> hits,
                     std::span<Surface> out) const {
  thread_local std::vector<std::uint32_t> solid;
  solid.clear();
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (is_solid(hits[i]))
      solid.push_back(static_cast<std::uint32_t>(i));
    else
      out[i] = surface(rays[i], hits[i]);
  }
  if (!solid.empty()) solid_surfaces(rays, hits, solid, out);
}

}  // namespace penumbra
