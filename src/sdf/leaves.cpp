#include "sdf/leaves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/rotation.h"

namespace penumbra::sdf {
namespace {

using Numbers = std::span<const double>;

Vec3d vec(Numbers n) { return {n[0], n[1], n[2]}; }

class Constants {
 public:
  Constants& add(double x) {
    list.push_back(static_cast<float>(x));
    return *this;
  }
  Constants& add(const Vec3d& v) { return add(v.x).add(v.y).add(v.z); }
  std::vector<float> list;
};

struct Point2 {
  double x, y;
};

void add_outline(Constants& c, const std::vector<Point2>& p) {
  c.add(static_cast<double>(p.size()));
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Point2 &a = p[i], &b = p[(i + p.size() - 1) % p.size()];
    const double ex = b.x - a.x, ey = b.y - a.y;
    c.add(a.x).add(a.y).add(ex).add(ey).add(1 / (ex * ex + ey * ey)).add(b.y);
  }
}

void add_profile(Constants& c, SdfProfile profile, Numbers n, double scale) {
  if (profile != SdfProfile::polygon) {
    for (const double x : n) c.add(x * scale);
    return;
  }
  std::vector<Point2> points;
  for (std::size_t i = 0; i + 1 < n.size(); i += 2)
    points.push_back({n[i] * scale, n[i + 1] * scale});
  add_outline(c, points);
}

Op with_profile(Op circle, SdfProfile profile) {
  return static_cast<Op>(static_cast<int>(circle) + static_cast<int>(profile) - 1);
}

Leaf flat(const std::vector<Vec3>& vertices) {
  Vec3d normal;
  const Vec3d origin(vertices[0]);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    normal +=
        cross(Vec3d(vertices[i]) - origin, Vec3d(vertices[(i + 1) % vertices.size()]) - origin);
  const Vec3d w = normalize(normal), u = normalize(Vec3d(vertices[1]) - origin), v = cross(w, u);
  Constants c;
  c.add(origin).add(u).add(v).add(w);
  std::vector<Point2> outline;
  outline.reserve(vertices.size());
  for (const Vec3& p : vertices)
    outline.push_back({dot(Vec3d(p) - origin, u), dot(Vec3d(p) - origin, v)});
  add_outline(c, outline);
  return {Op::flat_polygon, std::move(c.list)};
}

}  // namespace

bool takes_turn(SdfOp shape) {
  return shape == SdfOp::sphere || shape == SdfOp::capsule || shape == SdfOp::plane;
}

Leaf leaf_of(const SdfTree& tree, const SdfNode& node, const Placement& at) {
  const Numbers n = tree.numbers_of(node);
  const double s = at.scale;
  Constants c;
  if (node.op == SdfOp::plane) {
    const Vec3d normal = at.turn.vector(vec(n));
    c.add(normal).add(n[3] * s + dot(normal, at.offset));
    return {Op::plane, std::move(c.list)};
  }
  c.add(at.point(vec(n)));
  switch (node.op) {
    case SdfOp::sphere:
      c.add(n[3] * s);
      return {Op::sphere, std::move(c.list)};
    case SdfOp::box:
      c.add(vec(n.subspan(3)) * s);
      return {Op::box, std::move(c.list)};
    case SdfOp::round_box:
      c.add(vec(n.subspan(3)) * s - Vec3d(n[6] * s)).add(n[6] * s);
      return {Op::round_box, std::move(c.list)};
    case SdfOp::ellipsoid: {
      const Vec3d r = vec(n.subspan(3)) * s, inv(1 / r.x, 1 / r.y, 1 / r.z);
      c.add(inv).add(inv * inv).add(std::min({r.x, r.y, r.z}));
      return {Op::ellipsoid, std::move(c.list)};
    }
    case SdfOp::torus:
      c.add(n[3] * s).add(n[4] * s);
      return {Op::torus, std::move(c.list)};
    case SdfOp::capped_torus: {
      const double aperture = n[3] * std::numbers::pi / 180;
      c.add(std::sin(aperture)).add(std::cos(aperture)).add(n[4] * s).add(n[5] * s);
      return {Op::capped_torus, std::move(c.list)};
    }
    case SdfOp::capsule: {
      const Vec3d along = at.point(vec(n.subspan(3))) - at.point(vec(n));
      c.add(along).add(1 / dot(along, along)).add(n[6] * s);
      return {Op::capsule, std::move(c.list)};
    }
    case SdfOp::cylinder:
      c.add(n[3] * s).add(n[4] * s);
      return {Op::cylinder, std::move(c.list)};
    case SdfOp::capped_cone: {
      const double h = n[3] * s, lower = n[4] * s, upper = n[5] * s, dr = upper - lower;
      c.add(h).add(lower).add(upper).add(1 / (dr * dr + 4 * h * h));
      return {Op::capped_cone, std::move(c.list)};
    }
    case SdfOp::cone: {
      const double h = n[4] * s, r = h * std::tan(n[3] * std::numbers::pi / 180);
      c.add(r).add(h).add(1 / (r * r + h * h));
      return {Op::cone, std::move(c.list)};
    }
    case SdfOp::hexagonal_prism:
      c.add(n[3] * s).add(n[4] * s);
      return {Op::hexagonal_prism, std::move(c.list)};
    case SdfOp::octahedron:
      c.add(n[3] * s);
      return {Op::octahedron, std::move(c.list)};
    case SdfOp::link:
      c.add(n[3] * s).add(n[4] * s).add(n[5] * s);
      return {Op::link, std::move(c.list)};
    default:
      c.add(n[3] * s);
      add_profile(c, node.profile, tree.profile_numbers(node), s);
      return {with_profile(node.op == SdfOp::extrusion ? Op::extrude_circle : Op::revolve_circle,
                           node.profile),
              std::move(c.list)};
  }
}

Leaf leaf_of(const Sphere& sphere) {
  Constants c;
  c.add(Vec3d(sphere.center)).add(sphere.radius);
  return {Op::sphere, std::move(c.list)};
}

std::optional<Leaf> leaf_of(const Mesh& mesh) {
  if (const auto* box = std::get_if<ExactBox>(&mesh.exact)) {
    Constants c;
    const Vec3d lo(box->lo), hi(box->hi);
    c.add((lo + hi) * 0.5).add((hi - lo) * 0.5);
    return Leaf{Op::box, std::move(c.list)};
  }
  if (const auto* quad = std::get_if<ExactQuad>(&mesh.exact))
    return flat({quad->corner, quad->corner + quad->edge_u,
                 quad->corner + quad->edge_u + quad->edge_v, quad->corner + quad->edge_v});
  if (const auto* polygon = std::get_if<ExactPolygon>(&mesh.exact)) return flat(polygon->vertices);
  return {};
}

}  // namespace penumbra::sdf
