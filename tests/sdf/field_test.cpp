// Every shape, operator and transform against the reference; slopes; shortened code.
#include <gtest/gtest.h>

#include <random>

#include "reference.h"
#include "sdf/field.h"
#include "sdf/met_surface.h"
#include "sdf_scenes.h"

namespace penumbra::test {
namespace {

using sdf::Field;

std::vector<Vec3> random_points(std::size_t count, float size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-size, size);
  std::vector<Vec3> points(count);
  for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
  return points;
}

std::vector<float> distances(const Field& field, const std::vector<Vec3>& points) {
  std::vector<float> d(points.size());
  field.distance(points, d);
  return d;
}

void expect_reference(const std::string& root) {
  const Scene scene = scene_of(root);
  const Field field(scene);
  const Reference reference(scene.sdfs[0]);
  const auto points = random_points(500, 2, 1);
  const auto d = distances(field, points);
  int wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = reference(Vec3d(points[i]));
    if (std::abs(d[i] - truth) > 1e-5 * std::max(1.0, std::abs(truth))) {
      if (wrong++ == 0)
        ADD_FAILURE() << root << "\n at " << points[i].x << ", " << points[i].y << ", "
                      << points[i].z << ": " << d[i] << " instead of " << truth;
    }
  }
  EXPECT_EQ(wrong, 0) << root;
}

TEST(SdfField, ShapesAreQuilezs) {
  for (const std::string& root : shapes()) expect_reference(root);
}

TEST(SdfField, ShapesTurnedScaledAndMoved) {
  for (const std::string& root : shapes())
    expect_reference(R"({"op": "translate", "offset": [0.1, 0.2, 0.3], "child": {"op": "scale",
        "factor": 1.3, "child": {"op": "rotate", "rotate_deg": [30, -50, 70], "child": )" +
                     root + "}}}");
}

TEST(SdfField, OperatorsAreQuilezs) {
  for (const std::string& root : operators()) expect_reference(root);
}

TEST(SdfField, NoSteeperThanOne) {
  std::vector<std::string> roots = shapes();
  for (const std::string& root : operators()) roots.push_back(root);
  for (const std::string& root : roots) {
    const Field field(scene_of(root));
    ASSERT_TRUE(field.warnings().empty() || root.find("repeat") != root.npos) << root;
    if (!field.warnings().empty()) continue;
    const auto a = random_points(2000, 2, 2);
    auto b = random_points(2000, 0.1f, 3);
    for (std::size_t i = 0; i < a.size(); ++i) b[i] = a[i] + b[i] * (i % 2 ? 1.0f : 0.03f);
    const auto fa = distances(field, a), fb = distances(field, b);
    float steepest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      steepest = std::max(steepest, (std::abs(fa[i] - fb[i]) - 2e-6f) / length(a[i] - b[i]));
    EXPECT_LE(steepest, 1.0005f) << root;
  }
}

// Two hundred balls, spread out.
std::vector<std::string> crowds() {
  std::vector<std::string> roots;
  std::string many;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> u(-1.5f, 1.5f);
  for (int i = 0; i < 200; ++i)
    many += (i ? "," : "") + std::string(R"({"shape": "sphere", "radius": 0.1, "center": [)") +
            std::to_string(u(random)) + "," + std::to_string(u(random)) + "," +
            std::to_string(u(random)) + "]}";
  for (const std::string op : {R"("union")", R"("smooth_union", "k": 0.15)"})
    roots.push_back(R"({"op": )" + op + R"(, "children": [)" + many + "]}");
  return roots;
}

TEST(SdfField, CrowdsAreQuilezs) {
  for (const std::string& root : crowds()) expect_reference(root);
}

TEST(SdfField, ShortenedCodeGivesTheSameBits) {
  std::vector<std::string> roots = operators();
  for (const std::string& root : crowds()) roots.push_back(root);
  for (const std::string& root : roots) {
    const Scene scene = scene_of(root);
    sdf::FieldOptions whole;
    whole.prune = false;
    const Field pruned(scene), full(scene, whole);
    for (const float size : {1.5f, 6.0f, 40.0f}) {
      const auto points = random_points(3000, size, 5);
      EXPECT_EQ(distances(pruned, points), distances(full, points)) << root.substr(0, 300);
    }
  }
}

TEST(SdfField, OtherObjects) {
  const Scene scene = scene_with(R"(
      {"type": "sphere", "center": [0, 3, 0], "radius": 1, "material": "a"},
      {"type": "box", "min": [4, 0, 0], "max": [5, 1, 1], "material": "a"},
      {"type": "quad", "corner": [-9, 0, 0], "edge_u": [2, 0, 0], "edge_v": [1, 0, 3], "material": "b"},
      {"type": "polygon", "vertices": [[0, -9, 0], [2, -9, 0], [0, -9, 2]], "material": "b"})");
  const Field field(scene);
  EXPECT_NEAR(field.distance({0, 5, 0}), 1, 1e-6);
  EXPECT_NEAR(field.distance({4.5f, 0.5f, 0.5f}), -0.5f, 1e-6);
  EXPECT_NEAR(field.distance({-7.5f, 0.4f, 1.5f}), 0.4f, 1e-6);
  EXPECT_NEAR(field.distance({-9.5f, 0, 0}), 0.5f, 1e-6);
  EXPECT_NEAR(field.distance({-9, 0, 1.5f}), 1.5f / std::sqrt(10.0f), 1e-5);
  EXPECT_NEAR(field.distance({0.5f, -9.3f, 0.5f}), 0.3f, 1e-6);
  EXPECT_NEAR(field.distance({2, -9, 2}), std::sqrt(2.0f), 1e-6);
}

TEST(SdfField, NormalsPointAway) {
  const Field field(scene_of(R"({"shape": "sphere", "radius": 1})"));
  auto points = random_points(100, 1, 6);
  for (Vec3& p : points) p = normalize(p);
  std::vector<Vec3> normals(points.size());
  field.normal(points, normals);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_LT(length(normals[i] - points[i]), 2e-3f);
}

TEST(SdfField, NormalsBesideAnEdgeAreTheFacesOwn) {
  const Field field(scene_of(R"({"shape": "box", "min": [-1, -1, -1], "max": [1, 1, 1]})"));
  std::vector<sdf::MeetingPoint> met;
  for (float way : {1.5e-4f, 3e-4f, 6e-4f, 1.2e-3f})
    for (float x : {-0.7f, 0.1f, 0.9f})
      met.push_back({{x, 1, 1 - way}, normalize(Vec3(0, -0.1f, -1))});
  std::vector<Vec3> positions(met.size()), normals(met.size());
  sdf::surfaces(field, met, {1e-7f, 1}, positions, normals);
  for (std::size_t i = 0; i < met.size(); ++i) {
    EXPECT_LT(length(normals[i] - Vec3(0, 1, 0)), 0.01f) << i;
    EXPECT_LT(length(positions[i] - met[i].position), 1e-5f) << i;
  }
}

TEST(SdfField, SmoothUnionsBlendMaterials) {
  const Field field(scene_of(R"({"op": "smooth_union", "k": 0.5, "children": [
      {"shape": "sphere", "center": [-1, 0, 0], "radius": 1, "material": "a"},
      {"shape": "sphere", "center": [1, 0, 0], "radius": 1, "material": "b"}]})"));
  const auto middle = field.surface({0, 0.2f, 0});
  ASSERT_EQ(middle.parts.size(), 2u);
  EXPECT_NEAR(middle.parts[0].weight, 0.5f, 1e-3f);
  const auto left = field.surface({-2, 0, 0});
  ASSERT_EQ(left.parts.size(), 1u);
  EXPECT_EQ(left.parts[0].material, 0u);
  const auto right = field.surface({0.1f, 0.2f, 0});
  ASSERT_EQ(right.parts.size(), 2u);
  const float a = right.parts[0].material == 1 ? right.parts[0].weight : right.parts[1].weight;
  const double da = std::hypot(1.1, 0.2) - 1, db = std::hypot(0.9, 0.2) - 1,
               h = 1 - (da - db) / 0.5;
  EXPECT_NEAR(a, 1 - h * h / 2, 1e-3);
}

TEST(SdfField, UnboundedTwistWarnsByName) {
  const Scene scene = scene_with(R"({"type": "sdf", "name": "vine", "material": "a", "root":
      {"op": "union", "children": [{"shape": "sphere", "radius": 1}, {"op": "round", "radius": 0.1,
       "child": {"op": "twist", "rate": 1, "child": {"shape": "plane", "normal": [1, 0, 0]}}}]}})");
  const Field field(scene);
  ASSERT_EQ(field.warnings().size(), 1u);
  EXPECT_NE(field.warnings()[0].find("the twist at root.children[1].child of \"vine\""),
            std::string::npos);
  EXPECT_EQ(sdf::field_warnings(scene), field.warnings());
  EXPECT_FALSE(field.is_bounded());
}

TEST(SdfField, AThousandLevelsDeep) {
  std::string root = R"({"shape": "sphere", "radius": 1})";
  for (int i = 0; i < 500; ++i)
    root =
        R"({"op": "rotate", "rotate_deg": [0, 1, 0], "child": {"op": "smooth_intersection", "k": 0.01,
        "children": [{"shape": "sphere", "center": [0.3, 0, 0], "radius": 1}, )" +
        root + "]}}";
  const Scene scene = scene_of(root);
  const Field field(scene);
  const Reference reference(scene.sdfs[0]);
  for (const Vec3& p : random_points(50, 2, 7))
    EXPECT_NEAR(field.distance(p), reference(Vec3d(p)), 2e-5);
}

}  // namespace
}  // namespace penumbra::test
