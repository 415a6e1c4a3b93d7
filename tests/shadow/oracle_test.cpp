#include "shadow/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "shadow/profile.h"

namespace penumbra {
namespace {

using testing::Oracle;
using testing::OraclePoint;

class OnOracle : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, OnOracle, ::testing::ValuesIn(testing::oracle_names()),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

std::vector<float> fractions(const Scene& scene, const std::vector<OraclePoint>& points,
                             const ShadowOptions& options, float scale = 1) {
  const World world(scene);
  const Shadows shadows(world, options);
  ShadowCounts counts;
  std::vector<float> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Receiver receiver = points[i].receiver;
    receiver.position *= scale;
    out.push_back(shadows.visibility(receiver, points[i].light, i, counts).fraction);
  }
  return out;
}

TEST_P(OnOracle, AreaAgreesWithTheTruthForEveryLight) {
  const Oracle oracle(GetParam());
  ShadowOptions options;
  options.kind = ShadowKind::area;
  options.light_samples = 4096;
  const auto found = fractions(oracle.scene, oracle.points, options);
  std::map<std::size_t, std::pair<double, int>> squares;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const OraclePoint& p = oracle.points[i];
    squares[p.light].first += std::pow(found[i] - p.truth, 2);
    squares[p.light].second++;
  }
  EXPECT_EQ(squares.size(), oracle.scene.lights.size());
  // 4,096 stratified points, and the truth is good to 0.001.
  for (const auto& [light, sum] : squares)
    EXPECT_LT(std::sqrt(sum.first / sum.second), 0.003) << "light " << light;
}

TEST_P(OnOracle, HardEqualsAnExactRecomputation) {
  const Oracle oracle(GetParam());
  ShadowOptions options;
  options.kind = ShadowKind::hard;
  const auto found = fractions(oracle.scene, oracle.points, options);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const ConeQuery q = testing::paper_query(oracle.scene, oracle.points[i]);
    const double clearance = testing::paper_clearance(oracle.scene, q);
    if (clearance > 0 && clearance < 1e-5) continue;  // closer to the edge than floats are
    ASSERT_EQ(found[i], clearance > 0 ? 1 : 0) << "point " << i;
  }
}

TEST_P(OnOracle, ParkerEqualsThePaperWithoutTolerance) {
  const Oracle oracle(GetParam());
  ShadowOptions options;
  options.tolerance = 0;
  for (const Profile profile : {Profile::cubic, Profile::sine, Profile::linear}) {
    options.profile = profile;
    const auto found = fractions(oracle.scene, oracle.points, options);
    int penumbra = 0;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const ConeQuery q = testing::paper_query(oracle.scene, oracle.points[i]);
      const double tau = testing::paper_clearance(oracle.scene, q) / q.outer;
      const double s = profile == Profile::cubic  ? 3 * tau * tau - 2 * tau * tau * tau
                       : profile == Profile::sine ? (1 + std::sin(M_PI * tau - M_PI / 2)) / 2
                                                  : tau;
      penumbra += s > 0 && s < 1;
      ASSERT_NEAR(found[i], s, 0.001) << "point " << i << " light " << oracle.points[i].light;
    }
    EXPECT_GT(penumbra, 20);
  }
}

TEST_P(OnOracle, ParkerKeepsWithinItsTolerance) {
  const Oracle oracle(GetParam());
  ShadowOptions options;
  options.tolerance = 0;
  const auto exact = fractions(oracle.scene, oracle.points, options);
  for (const float tolerance : {0.005f, 0.02f, 0.1f}) {
    options.tolerance = tolerance;
    const auto found = fractions(oracle.scene, oracle.points, options);
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_NEAR(found[i], exact[i], tolerance + 1e-6f) << "point " << i;
    // No tolerance in the umbra: seams between triangles would show.
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (exact[i] > 0) continue;
      ASSERT_EQ(found[i], 0) << "point " << i;
    }
  }
}

TEST_P(OnOracle, ScaleChangesNothing) {
  const Oracle oracle(GetParam());
  for (const ShadowKind kind : {ShadowKind::hard, ShadowKind::area, ShadowKind::parker}) {
    ShadowOptions options;
    options.kind = kind;
    const auto expected = fractions(oracle.scene, oracle.points, options);
    for (const float f : {0.01f, 100.0f}) {
      const auto found = fractions(testing::scaled(oracle.scene, f), oracle.points, options, f);
      int flips = 0;  // hard edges, and single light points, that rounding moves across an edge
      for (std::size_t i = 0; i < found.size(); ++i)
        flips += std::abs(found[i] - expected[i]) > 0.002f;
      EXPECT_LE(flips, kind == ShadowKind::parker ? 0 : 3) << "scale " << f;
    }
  }
}

/// Root mean square error over all points with 0.002 < truth < 0.998.
double penumbra_error(const Oracle& oracle, ShadowKind kind) {
  ShadowOptions options;
  options.kind = kind;
  options.tolerance = 0;
  const World world(oracle.scene, {.field = options.marches_field()});
  const Shadows shadows(world, options);
  ShadowCounts counts;
  double sum = 0;
  int n = 0;
  for (std::size_t i = 0; i < oracle.points.size(); ++i) {
    const OraclePoint& p = oracle.points[i];
    if (p.truth <= 0.002 || p.truth >= 0.998) continue;
    const float found = shadows.visibility(p.receiver, p.light, i, counts).fraction;
    sum += std::pow(found - p.truth, 2), ++n;
  }
  return std::sqrt(sum / n);
}

TEST(Oracle, ErrorsStandWhereOthersFoundThem) {
  const std::vector<std::string> scenes{"three-spheres", "sphere-field", "bridge"};
  // Found independently.
  const std::map<ShadowKind, std::vector<double>> known = {
      {ShadowKind::hard, {0.271, 0.285, 0.273}},
      {ShadowKind::parker, {0.508, 0.558, 0.497}},
      {ShadowKind::sdf_classic, {0.331, 0.366, 0.311}},
      {ShadowKind::sdf_improved, {0.355, 0.390, 0.328}},
      {ShadowKind::sdf_inner, {0.038, 0.073, 0.053}}};
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Oracle oracle(scenes[i]);
    for (const auto& [kind, errors] : known)
      EXPECT_NEAR(penumbra_error(oracle, kind), errors[i], 0.005)
          << scenes[i] << " method " << static_cast<int>(kind);
  }
}

}  // namespace
}  // namespace penumbra
