// The published marches on OpenGL, against their formulas in double precision.
#include <cmath>

#include "gl/driver.h"
#include "render/gl/render_gl.h"
#include "scene/load.h"
#include "shadow/published_formulas.h"

namespace penumbra {
namespace {

double rmse(const testing::Oracle& oracle, const ShadowOptions& shadows) {
  RenderOptions options;
  options.shadows = shadows;
  std::vector<ProbeQuery> queries;
  for (const auto& p : oracle.points) queries.push_back({p.receiver, p.light});
  Progress silent;
  const ProbeAnswers found = probe_gl(oracle.scene, options, queries, silent);
  double sum = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const double e = found.fractions[i] - testing::formula(oracle.scene, shadows, oracle.points[i]);
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

TEST_F(Published, ThePlainMarchIsDarkWhereClassicIs) {
  const testing::Oracle oracle("bridge");
  std::vector<ProbeQuery> queries;
  for (const auto& p : oracle.points) queries.push_back({p.receiver, p.light});
  Progress silent;
  RenderOptions options;
  options.shadows.kind = ShadowKind::sdf_classic;
  const auto classic = probe_gl(oracle.scene, options, queries, silent).fractions;
  options.shadows.kind = ShadowKind::hard, options.shadows.variant = SdfVariant::march;
  const auto plain = probe_gl(oracle.scene, options, queries, silent).fractions;
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_EQ(plain[i], classic[i] > 0 ? 1.0f : 0.0f);
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
