// Distance fields in double precision, one point at a time, straight from Quilez's articles
// ("distance functions", "2D distance functions", "smooth minimum", "domain repetition").
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/scene.h"
#include "sdf/lipschitz.h"

namespace penumbra::test {

class Reference {
 public:
  explicit Reference(const SdfTree& tree) : t(tree), slopes(sdf::slopes_of(tree, "", ignored)) {}
  double operator()(const Vec3d& p) const { return at(0, p) / slopes[0].constant; }

 private:
  using V = Vec3d;
  static double len2(double x, double y) { return std::sqrt(x * x + y * y); }
  static double clamp(double x, double a, double b) { return std::min(std::max(x, a), b); }
  static V vec(std::span<const double> n) { return {n[0], n[1], n[2]}; }

  static double box2(double x, double y, double bx, double by) {
    const double dx = std::abs(x) - bx, dy = std::abs(y) - by;
    return len2(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0);
  }
  static double polygon(double x, double y, std::span<const double> v) {
    const int n = static_cast<int>(v.size() / 2);
    double d = (x - v[0]) * (x - v[0]) + (y - v[1]) * (y - v[1]), s = 1;
    for (int i = 0, j = n - 1; i < n; j = i, ++i) {
      const double ex = v[2 * j] - v[2 * i], ey = v[2 * j + 1] - v[2 * i + 1];
      const double wx = x - v[2 * i], wy = y - v[2 * i + 1];
      const double h = clamp((wx * ex + wy * ey) / (ex * ex + ey * ey), 0, 1);
      d = std::min(d, (wx - ex * h) * (wx - ex * h) + (wy - ey * h) * (wy - ey * h));
      const bool a = y >= v[2 * i + 1], b = y<v[2 * j + 1], c = ex * wy> ey * wx;
      if ((a && b && c) || (!a && !b && !c)) s = -s;
    }
    return s * std::sqrt(d);
  }
  double outline(const SdfNode& node, double x, double y) const {
    const auto n = t.profile_numbers(node);
    if (node.profile == SdfProfile::circle) return len2(x, y) - n[0];
    return node.profile == SdfProfile::box ? box2(x, y, n[0], n[1]) : polygon(x, y, n);
  }

  double shape(const SdfNode& node, V p) const {
    const auto n = t.numbers_of(node);
    if (node.op == SdfOp::plane) return dot(p, vec(n)) - n[3];
    if (node.op == SdfOp::capsule) {
      const V pa = p - vec(n), ba = vec(n.subspan(3)) - vec(n);
      return length(pa - ba * clamp(dot(pa, ba) / dot(ba, ba), 0, 1)) - n[6];
    }
    p = p - vec(n);
    const V q = abs(p);
    switch (node.op) {
      case SdfOp::sphere:
        return length(p) - n[3];
      case SdfOp::box:
      case SdfOp::round_box: {
        const double r = node.op == SdfOp::box ? 0 : n[6];
        const V d = q - vec(n.subspan(3)) + V(r);
        return length(max(d, V(0.0))) + std::min(max_component(d), 0.0) - r;
      }
      case SdfOp::ellipsoid: {
        const V r = vec(n.subspan(3));
        const double k0 = length(V(p.x / r.x, p.y / r.y, p.z / r.z));
        const double k1 = length(V(p.x / r.x / r.x, p.y / r.y / r.y, p.z / r.z / r.z));
        return k0 < 1 ? (k0 - 1) * std::min({r.x, r.y, r.z}) : k0 * (k0 - 1) / k1;
      }
      case SdfOp::torus:
        return len2(len2(p.x, p.z) - n[3], p.y) - n[4];
      case SdfOp::capped_torus: {
        const double a = n[3] * std::numbers::pi / 180, sx = std::sin(a), sy = std::cos(a);
        const double k = sy * q.x > sx * p.y ? q.x * sx + p.y * sy : len2(q.x, p.y);
        return std::sqrt(dot(p, p) + n[4] * n[4] - 2 * n[4] * k) - n[5];
      }
      case SdfOp::cylinder: {
        const double dx = len2(p.x, p.z) - n[4], dy = q.y - n[3];
        return std::min(std::max(dx, dy), 0.0) + len2(std::max(dx, 0.0), std::max(dy, 0.0));
      }
      case SdfOp::capped_cone: {
        const double h = n[3], r1 = n[4], r2 = n[5], x = len2(p.x, p.z), y = p.y;
        const double cax = x - std::min(x, y < 0 ? r1 : r2), cay = std::abs(y) - h;
        const double kx = r2 - r1, ky = 2 * h;
        const double f = clamp(((r2 - x) * kx + (h - y) * ky) / (kx * kx + ky * ky), 0, 1);
        const double cbx = x - r2 + kx * f, cby = y - h + ky * f;
        const double s = cbx < 0 && cay < 0 ? -1 : 1;
        return s * std::sqrt(std::min(cax * cax + cay * cay, cbx * cbx + cby * cby));
      }
      case SdfOp::cone: {
        const double h = n[4], qx = h * std::tan(n[3] * std::numbers::pi / 180), qy = -h;
        const double wx = len2(p.x, p.z), wy = p.y;
        const double f = clamp((wx * qx + wy * qy) / (qx * qx + qy * qy), 0, 1);
        const double ax = wx - qx * f, ay = wy - qy * f;
        const double bx = wx - qx * clamp(wx / qx, 0, 1), by = wy - qy;
        const double s = std::max(-(wx * qy - wy * qx), -(wy - qy));
        const double d = std::sqrt(std::min(ax * ax + ay * ay, bx * bx + by * by));
        return s > 0 ? d : -d;
      }
      case SdfOp::hexagonal_prism: {
        const double kx = -std::sqrt(0.75), ky = 0.5, kz = std::tan(std::numbers::pi / 6);
        double x = q.x, y = q.y;
        const double f = 2 * std::min(kx * x + ky * y, 0.0);
        x -= f * kx, y -= f * ky;
        const double side = len2(x - clamp(x, -kz * n[3], kz * n[3]), y - n[3]);
        const double dx = y < n[3] ? -side : side, dy = q.z - n[4];
        return std::min(std::max(dx, dy), 0.0) + len2(std::max(dx, 0.0), std::max(dy, 0.0));
      }
      case SdfOp::octahedron: {
        const double s = n[3], m = q.x + q.y + q.z - s;
        V r;
        if (3 * q.x < m)
          r = q;
        else if (3 * q.y < m)
          r = {q.y, q.z, q.x};
        else if (3 * q.z < m)
          r = {q.z, q.x, q.y};
        else
          return m / std::sqrt(3.0);
        const double k = clamp(0.5 * (r.z - r.y + s), 0, s);
        return length(V(r.x, r.y - s + k, r.z - k));
      }
      case SdfOp::link:
        return len2(len2(p.x, std::max(q.y - n[3], 0.0)) - n[4], p.z) - n[5];
      case SdfOp::extrusion: {
        const double wx = outline(node, p.x, p.y), wy = q.z - n[3];
        return std::min(std::max(wx, wy), 0.0) + len2(std::max(wx, 0.0), std::max(wy, 0.0));
      }
      default:
        return outline(node, len2(p.x, p.z) - n[3], p.y);
    }
  }

  static double smin(double a, double b, double k) {
    if (k == 0) return std::min(a, b);
    const double h = std::max(k - std::abs(a - b), 0.0);
    return std::min(a, b) - h * h / (4 * k);
  }
  double child(const SdfNode& node, std::uint32_t i, const V& p) const {
    const std::uint32_t c = node.first_child + i;
    return at(c, p) / (sdf::divides_children(node.op) ? slopes[c].constant : 1.0);
  }

  double several(const SdfNode& node, const V& p) const {
    const double k = node.number_count ? t.numbers_of(node)[0] : 0;
    double a = child(node, 0, p);
    for (std::uint32_t i = 1; i < node.child_count; ++i) {
      const double b = child(node, i, p);
      switch (node.op) {
        case SdfOp::union_:
        case SdfOp::smooth_union:
          a = smin(a, b, k);
          break;
        case SdfOp::intersection:
        case SdfOp::smooth_intersection:
          a = -smin(-a, -b, k);
          break;
        default:
          a = -smin(-a, b, k);
      }
    }
    return a;
  }

  double turned(std::size_t index, const SdfNode& node, V p, int u, int v, int along) const {
    const double reach = slopes[index].reach, r = len2(p[u], p[v]), e = std::max(r - reach, 0.0);
    if (e > 0) p[u] *= reach / r, p[v] *= reach / r;
    const double a = t.numbers_of(node)[0] * p[along], c = std::cos(a), s = std::sin(a);
    V q = p;
    q[u] = c * p[u] + s * p[v], q[v] = -s * p[u] + c * p[v];
    const double d = child(node, 0, q);
    return e > 0 ? len2(e, std::max(d, 0.0)) : d;
  }

  // All copies within two cells, the file's rule being the two nearest ones along each axis.
  double repeated(const SdfNode& node, const V& p) const {
    const auto n = t.numbers_of(node);
    double least = INFINITY;
    for (int m = 0; m < 8; ++m) {
      V q = p;
      for (int i = 0; i < 3; ++i) {
        if (n[i] == 0) continue;
        const double limit = n[3 + i] < 0 ? INFINITY : n[3 + i];
        double id = clamp(std::round(p[i] / n[i]), -limit, limit);
        if (m >> i & 1) id = clamp(id + (p[i] - n[i] * id < 0 ? -1 : 1), -limit, limit);
        q[i] = p[i] - n[i] * id;
      }
      least = std::min(least, child(node, 0, q));
    }
    return least;
  }

  static V rotate_back(V p, const V& degrees) {
    for (int axis = 2; axis >= 0; --axis) {
      const double a = -degrees[axis] * std::numbers::pi / 180, c = std::cos(a), s = std::sin(a);
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double pu = p[u], pv = p[v];
      p[u] = c * pu - s * pv, p[v] = s * pu + c * pv;
    }
    return p;
  }

  double at(std::size_t index, V p) const {
    const SdfNode& node = t.nodes[index];
    const auto n = t.numbers_of(node);
    switch (node.op) {
      case SdfOp::onion:
        return std::abs(child(node, 0, p)) - n[0];
      case SdfOp::round:
        return child(node, 0, p) - n[0];
      case SdfOp::displace:
        return child(node, 0, p) +
               n[0] * std::sin(n[1] * p.x) * std::sin(n[2] * p.y) * std::sin(n[3] * p.z);
      case SdfOp::translate:
        return child(node, 0, p - vec(n));
      case SdfOp::rotate:
        return child(node, 0, rotate_back(p, vec(n)));
      case SdfOp::scale: {
        const double least = std::min({std::abs(n[0]), std::abs(n[1]), std::abs(n[2])});
        return child(node, 0, {p.x / n[0], p.y / n[1], p.z / n[2]}) * least;
      }
      case SdfOp::mirror:
        for (int i = 0; i < 3; ++i)
          if (n[i] != 0) p[i] = std::abs(p[i]);
        return child(node, 0, p);
      case SdfOp::repeat:
        return repeated(node, p);
      case SdfOp::twist:
        return turned(index, node, p, 0, 2, 1);
      case SdfOp::bend:
        return turned(index, node, p, 0, 1, 0);
      case SdfOp::elongate:
        for (int i = 0; i < 3; ++i) p[i] -= clamp(p[i], -n[i], n[i]);
        return child(node, 0, p);
      default:
        return node.child_count ? several(node, p) : shape(node, p);
    }
  }

  const SdfTree& t;
  std::vector<std::string> ignored;
  std::vector<sdf::NodeSlope> slopes;
};

}  // namespace penumbra::test
