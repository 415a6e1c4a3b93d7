// Soft shadows of distance fields, and rays through them, against the formulas and the truth.
#include <gtest/gtest.h>

#include "shadow/published_formulas.h"

namespace penumbra::testing {
namespace {

template <class Expected>
double rmse(const World& world, const Oracle& oracle, const ShadowOptions& options,
            const Expected& expected) {
  const Shadows shadows(world, options);
  ShadowCounts counts;
  double sum = 0;
  for (std::size_t i = 0; i < oracle.points.size(); ++i) {
    const OraclePoint& p = oracle.points[i];
    const double e =
        double{shadows.visibility(p.receiver, p.light, i, counts).fraction} - expected(p);
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(oracle.points.size()));
}

class FieldMarches : public ::testing::TestWithParam<std::string> {};

// But abs, which rests on the surfaces it meets, where rounding decides whether it ever gets in.
TEST_P(FieldMarches, EqualTheirFormulas) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene, {.cone_tree = false, .field = true});
  for (const auto& [kind, variant] : {std::pair{ShadowKind::sdf_classic, SdfVariant::published},
                                      {ShadowKind::sdf_classic, SdfVariant::blog},
                                      {ShadowKind::sdf_improved, SdfVariant::published},
                                      {ShadowKind::sdf_inner, SdfVariant::published}}) {
    ShadowOptions options;
    options.kind = kind, options.variant = variant;
    EXPECT_LT(rmse(world, oracle, options,
                   [&](const OraclePoint& p) { return formula(oracle.scene, options, p); }),
              0.005)
        << int(kind) << ' ' << int(variant);
  }
}

TEST_P(FieldMarches, ThePlainMarchIsDarkWhereClassicIs) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene, {.cone_tree = false, .field = true});
  ShadowOptions options;
  options.kind = ShadowKind::sdf_classic;
  const Shadows classic(world, options);
  options.kind = ShadowKind::hard, options.variant = SdfVariant::march;
  const Shadows plain(world, options);
  ShadowCounts counts;
  int dark = 0;
  for (const OraclePoint& p : oracle.points) {
    const float soft = classic.visibility(p.receiver, p.light, 0, counts).fraction;
    EXPECT_EQ(plain.visibility(p.receiver, p.light, 0, counts).fraction, soft > 0 ? 1.0f : 0.0f);
    dark += soft == 0;
  }
  EXPECT_GT(dark, 0);
}

TEST_P(FieldMarches, KStandsForTheLightsSize) {
  const Oracle oracle(GetParam());
  const World world(oracle.scene, {.cone_tree = false, .field = true});
  ShadowOptions options;
  options.kind = ShadowKind::sdf_classic, options.k = 8.0f;
  EXPECT_LT(rmse(world, oracle, options,
                 [&](const OraclePoint& p) { return formula(oracle.scene, options, p); }),
            0.005);
}

SdfNode leaf(SdfTree& tree, SdfOp op, std::initializer_list<double> numbers) {
  SdfNode node;
  node.op = op;
  node.first_number = static_cast<std::uint32_t>(tree.numbers.size());
  node.number_count = static_cast<std::uint32_t>(numbers.size());
  tree.numbers.insert(tree.numbers.end(), numbers);
  return node;
}

/// Spheres and boxes as one distance-field object; the floor stays as it is.
Scene as_distance_field(const Scene& from) {
  Scene scene = from;
  scene.spheres.clear(), scene.instances.clear();
  SdfTree tree;
  tree.nodes.emplace_back().op = SdfOp::union_;
  for (const Sphere& s : from.spheres)
    tree.nodes.push_back(leaf(tree, SdfOp::sphere, {s.center.x, s.center.y, s.center.z, s.radius}));
  for (const Instance& instance : from.instances) {
    const auto* box = std::get_if<ExactBox>(&from.meshes[instance.mesh].exact);
    if (!box) {
      scene.instances.push_back(instance);
      continue;
    }
    const Vec3 c = (box->lo + box->hi) * 0.5f, h = (box->hi - box->lo) * 0.5f;
    tree.nodes.push_back(leaf(tree, SdfOp::box, {c.x, c.y, c.z, h.x, h.y, h.z}));
  }
  if (tree.nodes.size() == 1) return from;  // a sheet alone
  tree.nodes[0].first_child = 1;
  tree.nodes[0].child_count = static_cast<std::uint32_t>(tree.nodes.size() - 1);
  scene.sdfs.push_back(std::move(tree));
  return scene;
}

TEST_P(FieldMarches, AreaThroughAFieldAgreesWithTheTruth) {
  const Oracle oracle(GetParam());
  const Scene scene = as_distance_field(oracle.scene);
  const World world(scene, {.cone_tree = false});
  ShadowOptions options;
  options.kind = ShadowKind::area, options.light_samples = 256;
  EXPECT_LT(rmse(world, oracle, options, [](const OraclePoint& p) { return p.truth; }), 0.01);
}

TEST_P(FieldMarches, HardThroughAFieldIsHardThroughTriangles) {
  const Oracle oracle(GetParam());
  const Scene scene = as_distance_field(oracle.scene);
  const World marched(scene, {.cone_tree = false}), traced(oracle.scene, {.cone_tree = false});
  ShadowOptions options;
  options.kind = ShadowKind::hard;
  const Shadows triangles(traced, options);
  ShadowCounts counts;
  const double e = rmse(marched, oracle, options, [&](const OraclePoint& p) {
    return double{triangles.visibility(p.receiver, p.light, 0, counts).fraction};
  });
  // A few points lie on an edge of the shadow to rounding.
  EXPECT_LT(e * e * static_cast<double>(oracle.points.size()), 4);
}

TEST_P(FieldMarches, ParkerOnTrianglesOfTheField) {
  const Oracle oracle(GetParam());
  const Scene scene = as_distance_field(oracle.scene);
  const World converted(scene), exact(oracle.scene);
  ShadowOptions options;
  options.tolerance = 0;
  const Shadows parker(exact, options);
  ShadowCounts counts;
  EXPECT_LT(rmse(converted, oracle, options,
                 [&](const OraclePoint& p) {
                   return double{parker.visibility(p.receiver, p.light, 0, counts).fraction};
                 }),
            0.03);
}

INSTANTIATE_TEST_SUITE_P(Oracle, FieldMarches, ::testing::ValuesIn(oracle_names()),
                         [](const auto& which) {
                           std::string name = which.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(FieldMarches, OutOfStepsIsCounted) {
  const Oracle oracle("bridge");
  const World world(oracle.scene, {.cone_tree = false, .field = true});
  ShadowOptions options;
  options.kind = ShadowKind::sdf_classic, options.steps = 2;
  const Shadows shadows(world, options);
  ShadowCounts counts;
  for (const OraclePoint& p : oracle.points) shadows.visibility(p.receiver, p.light, 0, counts);
  EXPECT_EQ(counts.marches, oracle.points.size());
  EXPECT_GT(counts.unfinished_marches, counts.marches / 2);
  EXPECT_LE(counts.march_steps, 2 * counts.marches);
}

}  // namespace
}  // namespace penumbra::testing
