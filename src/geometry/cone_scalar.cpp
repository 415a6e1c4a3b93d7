#include "geometry/cone_scalar.h"

#include <penumbra/parker.h>

namespace penumbra {
namespace {

parker::Vec plain(const Vec3& v) { return {v.x, v.y, v.z}; }

parker::ShadowRay shadow_ray(const LocalQuery& q) {
  return {plain(q.origin), plain(q.ray.w), q.t_max, 0};
}
parker::HalfSpace above(const LocalQuery& q) {
  return {plain(q.horizon), dot(q.horizon, q.origin) + q.epsilon};
}
parker::HalfSpace before(const LocalQuery& q) {
  if (!q.has_plane) return parker::detail::everything;
  return {plain(q.plane_normal),
          dot(q.plane_normal, q.origin) - q.plane_distance + q.plane_epsilon};
}

// The point of a side that the ray passes nearest to, found where both ends are seen from the
// origin: in the plane at unit distance.
Vec3 nearest_on_side(Vec3 a, Vec3 b) {
  if (a.z <= 0 && b.z <= 0) return a;
  const float front = 1e-4f * std::max(a.z, b.z);
  if (a.z < front) a = b + (a - b) * ((b.z - front) / (b.z - a.z));
  if (b.z < front) b = a + (b - a) * ((a.z - front) / (a.z - b.z));
  const Vec2 from{a.x / a.z, a.y / a.z}, along{b.x / b.z - from.x, b.y / b.z - from.y};
  const float square = along.x * along.x + along.y * along.y;
  const float s =
      square > 0 ? std::clamp(-(from.x * along.x + from.y * along.y) / square, 0.0f, 1.0f) : 0.0f;
  // Back from the projected side to the side itself.
  return a + (b - a) * (s * a.z / (b.z + s * (a.z - b.z)));
}

// The point of triangle abc that the ray meets or, failing that, passes nearest to, searched on its
// sides; ray coordinates.
Vec3 nearest_point(const Vec3* p, bool inside) {
  if (inside) {
    const float e0 = p[1].x * p[2].y - p[2].x * p[1].y, e1 = p[2].x * p[0].y - p[0].x * p[2].y,
                e2 = p[0].x * p[1].y - p[1].x * p[0].y, sum = e0 + e1 + e2;
    return (p[0] * e0 + p[1] * e1 + p[2] * e2) / sum;
  }
  Vec3 best = p[0];
  float least = INFINITY;
  for (int i = 0; i < 3; ++i) {
    const Vec3 at = nearest_on_side(p[i], p[(i + 1) % 3]);
    const float c = at.z > 0 ? std::hypot(at.x, at.y) / at.z : INFINITY;
    if (c < least) least = c, best = at;
  }
  return best;
}

void barycentric(const Vec3* p, const Vec3& at, float& b1, float& b2) {
  const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0], r = at - p[0], n = cross(e1, e2);
  const float nn = dot(n, n);
  b1 = nn > 0 ? dot(cross(r, e2), n) / nn : 0;
  b2 = nn > 0 ? dot(cross(e1, r), n) / nn : 0;
}

}  // namespace

float scalar_triangle(const TriangleLeaf& leaf, std::size_t lane, const LocalQuery& q) {
  parker::Vec p[3];
  for (int v = 0; v < 3; ++v)
    p[v] = {leaf.position[v][0][lane], leaf.position[v][1][lane], leaf.position[v][2][lane]};
  return parker::triangle_clearance(shadow_ray(q), p[0], p[1], p[2], above(q), before(q));
}

float scalar_sphere(const SphereLeaf& leaf, std::size_t lane, const LocalQuery& q) {
  const parker::Vec c{leaf.center[0][lane], leaf.center[1][lane], leaf.center[2][lane]};
  return parker::sphere_clearance(shadow_ray(q), c, leaf.radius[lane], above(q), before(q));
}

float cut_out_clearance(const ConeTree::Data& data, const CutOut& cut, const LocalQuery& q) {
  const float clearance =
      parker::triangle_clearance(shadow_ray(q), plain(cut.position[0]), plain(cut.position[1]),
                                 plain(cut.position[2]), above(q), before(q));
  if (!(clearance < INFINITY) || q.lower_bound) return clearance;
  Vec3 p[3];
  for (int i = 0; i < 3; ++i) {
    const Vec3 r = cut.position[i] - q.origin;
    p[i] = {dot(r, q.ray.u), dot(r, q.ray.v), dot(r, q.ray.w)};
  }
  const Vec3 at = nearest_point(p, clearance == 0);
  float b1 = 0, b2 = 0;
  barycentric(p, at, b1, b2);
  const Instance& instance = data.scene->instances[cut.instance];
  const MaskedMesh masked{&data.scene->meshes[instance.mesh],
                          &data.scene->materials[instance.material],
                          data.masks.find(instance.material)};
  const float gap = masked.distance(cut.triangle, b1, b2, cut.world_scale);
  return gap > 0 ? clearance + gap / std::max(at.z, 1e-30f) : clearance;
}

}  // namespace penumbra
