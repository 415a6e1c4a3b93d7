// The published marches on OpenGL, against their formulas in double precision.
#include <cmath>
#include <functional>

#include "gl/driver.h"
#include "render/gl/render_gl.h"
#include "scene/load.h"
#include "shadow/oracle.h"

namespace penumbra {
namespace {

using Field = std::function<double(const Vec3d&)>;

double box_distance(const Vec3d& p, const Vec3d& lo, const Vec3d& hi) {
  const Vec3d q = abs(p - (lo + hi) * 0.5) - (hi - lo) * 0.5;
  return length(max(q, Vec3d(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0);
}

// Spheres, boxes and the oracle's axis-parallel floors.
double distance(const Scene& scene, const Vec3d& p) {
  double d = INFINITY;
  for (const Sphere& s : scene.spheres) d = std::min(d, length(p - Vec3d(s.center)) - s.radius);
  for (const Mesh& mesh : scene.meshes) {
    if (const auto* box = std::get_if<ExactBox>(&mesh.exact))
      d = std::min(d, box_distance(p, Vec3d(box->lo), Vec3d(box->hi)));
    if (const auto* quad = std::get_if<ExactQuad>(&mesh.exact)) {
      const Vec3d a(quad->corner), b(quad->corner + quad->edge_u + quad->edge_v);
      d = std::min(d, box_distance(p, min(a, b), max(a, b)));
    }
  }
  return d;
}

struct March {
  Vec3d origin, direction;
  double mint, maxt, w;
};

double classic(const Field& map, const March& m, bool blog) {
  double res = 1, t = m.mint;
  for (int i = 0; i < 256 && t < (blog ? std::min(m.maxt, 150.0) : m.maxt); ++i) {
    const double h = map(m.origin + m.direction * t);
    if (h < (blog ? 0.0001 : 0.001)) return 0;
    if (blog) t += h;
    res = std::min(res, h / (m.w * t));
    if (!blog) t += h;
  }
  return res;
}

double improved(const Field& map, const March& m) {
  double res = 1, ph = 1e20, t = m.mint;
  for (int i = 0; i < 256 && t < m.maxt; ++i) {
    const double h = map(m.origin + m.direction * t);
    if (h < 0.001) return 0;
    const double y = h * h / (2 * ph), d = std::sqrt(h * h - y * y);
    const double ratio = d / (m.w * std::max(0.0, t - y));
    if (!std::isnan(ratio)) res = std::min(res, ratio);
    ph = h;
    t += h;
  }
  return res;
}

double inner(const Field& map, const March& m, bool absolute) {
  double res = 1, t = m.mint;
  for (int i = 0; i < 256 && t < m.maxt; ++i) {
    const double h = map(m.origin + m.direction * t);
    res = std::min(res, h / (m.w * t));
    t += absolute ? std::abs(h) : std::clamp(h, 0.005, 0.5);
    if (res < -1 || t > m.maxt) break;
  }
  res = std::max(res, -1.0);
  return 0.25 * (1 + res) * (1 + res) * (2 - res);
}

// Where a ray leaves the scene's bounds enlarged by their diagonal.
double way_out(const Scene& scene, const Vec3d& o, const Vec3d& d) {
  const Bounds box = bounds_of(scene);
  const Vec3d grow(static_cast<double>(box.diagonal()));
  const Vec3d lo = Vec3d(box.lo) - grow, hi = Vec3d(box.hi) + grow;
  double t = INFINITY;
  for (int i = 0; i < 3; ++i)
    if (d[i] != 0) t = std::min(t, ((d[i] > 0 ? hi[i] : lo[i]) - o[i]) / d[i]);
  return t;
}

double formula(const Scene& scene, const ShadowOptions& o, const testing::OraclePoint& p) {
  const auto view = *LightViews(scene).view(p.light, p.receiver.position);
  March m{Vec3d(p.receiver.position), Vec3d(view.direction), 0.01, view.distance,
          0.5 * view.diameter_over_distance};
  if (std::isinf(m.maxt)) m.maxt = way_out(scene, m.origin, m.direction);
  if (o.k) m.w = 1 / *o.k;
  const Field map = [&](const Vec3d& q) { return distance(scene, q); };
  if (o.kind == ShadowKind::sdf_improved) return improved(map, m);
  if (o.kind == ShadowKind::sdf_inner) return inner(map, m, o.variant == SdfVariant::abs);
  return classic(map, m, o.variant == SdfVariant::blog);
}

double rmse(const testing::Oracle& oracle, const ShadowOptions& shadows) {
  RenderOptions options;
  options.shadows = shadows;
  std::vector<ProbeQuery> queries;
  for (const auto& p : oracle.points) queries.push_back({p.receiver, p.light});
  Progress silent;
  const ProbeAnswers found = probe_gl(oracle.scene, options, queries, silent);
  double sum = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double e = found.fractions[i] - formula(oracle.scene, shadows, oracle.points[i]);
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(queries.size()));
}

class Published : public testing::GlTest {};

TEST_F(Published, MarchesEqualTheirFormulas) {
  for (const char* name : {"three-spheres", "bridge", "thin-wall"}) {
    const testing::Oracle oracle(name);
    for (const auto& [kind, variant] : {std::pair{ShadowKind::sdf_classic, SdfVariant::published},
                                        {ShadowKind::sdf_classic, SdfVariant::blog},
                                        {ShadowKind::sdf_improved, SdfVariant::published},
                                        {ShadowKind::sdf_inner, SdfVariant::published}}) {
      ShadowOptions shadows;
      shadows.kind = kind, shadows.variant = variant;
      EXPECT_LT(rmse(oracle, shadows), 0.005) << name << ' ' << int(kind) << ' ' << int(variant);
    }
  }
}

TEST_F(Published, KStandsForTheLightsSize) {
  const testing::Oracle oracle("bridge");
  ShadowOptions shadows;
  shadows.kind = ShadowKind::sdf_classic;
  shadows.k = 8.0f;
  EXPECT_LT(rmse(oracle, shadows), 0.005);
}

TEST_F(Published, AreaAgreesWithTheTruth) {
  const testing::Oracle oracle("slats");
  RenderOptions options;
  options.shadows.kind = ShadowKind::area;
  options.shadows.light_samples = 1024;
  std::vector<ProbeQuery> queries;
  for (const auto& p : oracle.points) queries.push_back({p.receiver, p.light});
  Progress silent;
  const ProbeAnswers found = probe_gl(oracle.scene, options, queries, silent);
  double sum = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double e = found.fractions[i] - oracle.points[i].truth;
    sum += e * e;
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(queries.size())), 0.01);
}

}  // namespace
}  // namespace penumbra
