// Code without what does not matter gives the same bits: random trees, long chains.
#include <gtest/gtest.h>

#include <random>

#include "reference.h"
#include "sdf/field.h"
#include "sdf/field_data.h"
#include "sdf_scenes.h"

namespace penumbra::test {
namespace {

using sdf::Field;

class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  std::string node(int levels) {
    if (levels == 0) return shape(1.5);
    const int kind = pick(10);
    if (kind < 6) return several(levels, 2 + pick(3));
    const std::string child = node(levels - 1);
    switch (kind) {
      case 6:
        return R"({"op": "translate", "offset": )" + vec(0.5) + R"(, "child": )" + child + "}";
      case 7:
        return R"({"op": "rotate", "rotate_deg": )" + vec(90) + R"(, "child": )" + child + "}";
      case 8:
        return R"({"op": "scale", "factor": [1.2, 0.8, )" + number(0.9, 1.1) + R"(], "child": )" +
               child + "}";
      default:
        return R"({"op": "onion", "thickness": 0.05, "child": )" + child + "}";
    }
  }

  /// One smooth union of many in no order.
  std::string chain(int count, double size, double k) {
    std::string text = R"({"op": "smooth_union", "k": )" + std::to_string(k) + R"(, "children": [)";
    for (int i = 0; i < count; ++i) text += (i ? "," : "") + shape(size);
    return text + "]}";
  }

  /// The same shapes as unions of two, nested to the left.
  std::string nested_chain(int count, double size) {
    std::string text = shape(size);
    for (int i = 1; i < count; ++i)
      text = R"({"op": "smooth_union", "k": )" + number(0.01, 0.3) + R"(, "children": [)" + text +
             "," + shape(size) + "]}";
    return text;
  }

  std::string shape(double size) {
    const std::string center = R"("center": )" + vec(size);
    const std::string r = number(0.05, 0.4), thin = number(0.02, 0.1);
    switch (pick(7)) {
      case 0:
        return R"({"shape": "box", )" + center + R"(, "half_size": [)" + r + ", " + thin + ", " +
               r + "]}";
      case 1:
        return R"({"shape": "torus", )" + center + R"(, "major_radius": )" + r +
               R"(, "minor_radius": )" + thin + "}";
      case 2:
        return R"({"shape": "capsule", "from": )" + vec(size) + R"(, "to": )" + vec(size) +
               R"(, "radius": )" + thin + "}";
      case 3:
        return R"({"shape": "ellipsoid", )" + center + R"(, "radii": [)" + r + ", " + thin + ", " +
               r + "]}";
      case 4:
        return R"({"shape": "link", )" + center + R"(, "half_length": )" + r +
               R"(, "major_radius": )" + r + R"(, "minor_radius": )" + thin + "}";
      default:
        return R"({"shape": "sphere", )" + center + R"(, "radius": )" + r + "}";
    }
  }

 private:
  int pick(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }
  std::string number(double lo, double hi) {
    return std::to_string(std::uniform_real_distribution(lo, hi)(random_));
  }
  std::string vec(double size) {
    return "[" + number(-size, size) + ", " + number(-size, size) + ", " + number(-size, size) +
           "]";
  }
  std::string several(int levels, int count) {
    constexpr const char* ops[] = {R"("union")",
                                   R"("intersection")",
                                   R"("difference")",
                                   R"("smooth_union", "k": 0.2)",
                                   R"("smooth_union", "k": 0.6)",
                                   R"("smooth_intersection", "k": 0.15)",
                                   R"("smooth_difference", "k": 0.1)"};
    std::string text = std::string(R"({"op": )") + ops[pick(7)] + R"(, "children": [)";
    for (int i = 0; i < count; ++i) text += (i ? "," : "") + node(levels - 1);
    return text + "]}";
  }

  std::mt19937 random_;
};

/// Packets near and far, narrow and wide.
std::vector<Vec3> packets(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> u(-1, 1);
  std::vector<Vec3> points;
  for (const float size : {1.0f, 3.0f, 12.0f, 100.0f})
    for (const float width : {1e-3f, 0.1f, 3.0f})
      for (int packet = 0; packet < 12; ++packet) {
        const Vec3 at(size * u(random), size * u(random), size * u(random));
        for (int i = 0; i < 16; ++i)
          points.push_back(at + Vec3(u(random), u(random), u(random)) * width);
      }
  return points;
}

void expect_same_bits(const std::string& root, unsigned seed) {
  const Scene scene = scene_of(root);
  sdf::FieldOptions whole;
  whole.prune = false;
  const Field shortened(scene), full(scene, whole);
  const std::vector<Vec3> points = packets(seed);
  std::vector<float> a(points.size()), b(points.size());
  shortened.distance(points, a);
  full.distance(points, b);
  EXPECT_EQ(a, b) << root.substr(0, 400);
  const Reference reference(scene.sdfs[0]);
  int wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double truth = reference(Vec3d(points[i]));
    wrong += std::abs(a[i] - truth) > 2e-5 * std::max(1.0, length(Vec3d(points[i])));
  }
  EXPECT_EQ(wrong, 0) << root.substr(0, 400);
}

TEST(ShortenedCode, OfRandomTrees) {
  for (unsigned seed = 0; seed < 60; ++seed)
    expect_same_bits(RandomTree(seed).node(1 + static_cast<int>(seed % 4)), seed);
}

TEST(ShortenedCode, OfChains) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    RandomTree random(seed);
    const double size = seed % 2 ? 1.5 : 8;
    expect_same_bits(random.chain(70 + 60 * static_cast<int>(seed), size, seed < 3 ? 0.05 : 0.8),
                     seed);
    expect_same_bits(random.nested_chain(100, size), seed);
  }
}

TEST(ShortenedCode, OfChainsThatAreTakenAway) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    RandomTree random(seed);
    for (const char* op : {"difference", "smooth_difference", "smooth_intersection"}) {
      std::string root = std::string(R"({"op": ")") + op + R"(", )";
      if (op[0] == 's') root += R"("k": 0.2, )";
      root += R"("children": [{"shape": "box", "half_size": [2, 1, 2]}, )";
      root += R"({"op": "rotate", "rotate_deg": [10, 40, 5], "child": )";
      expect_same_bits(root + random.chain(90, 2, 0.1) + "}]}", seed);
    }
  }
}

TEST(ShortenedCode, LongChainsAreRuns) {
  RandomTree random(1);
  const Field nary(scene_of(random.chain(1000, 4, 0.05)));
  const Field nested(scene_of(random.nested_chain(200, 4)));
  ASSERT_EQ(nary.data().tape.runs.size(), 1u);
  ASSERT_EQ(nested.data().tape.runs.size(), 1u);
  EXPECT_EQ(nary.data().tape.runs[0].count, 999u);
  EXPECT_EQ(nested.data().tape.runs[0].count, 199u);
  // No cell keeps a long code of its own beside them.
  const auto& codes = nary.data().regions.codes;
  for (std::size_t i = 1; i < codes.size(); ++i) EXPECT_LE(codes[i].count, 64u);
  const Field few(scene_of(random.chain(20, 4, 0.05)));
  EXPECT_TRUE(few.data().tape.runs.empty());
}

TEST(ShortenedCode, NothingFartherThanItsCluster) {
  const Scene scene = scene_of(RandomTree(3).chain(300, 4, 0.05));
  const Field field(scene);
  const sdf::Run& run = field.data().tape.runs.at(0);
  const SdfTree& tree = scene.sdfs[0];
  for (const Vec3& p : packets(9))
    for (std::uint32_t c = 0; c < run.clusters; ++c) {
      const float* box = &run.boxes[6 * c];
      double square = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double far = std::max(double{std::abs(p[axis] - box[axis])} - box[3 + axis], 0.0);
        square += far * far;
      }
      if (square == 0) continue;
      for (std::uint32_t m = run.first_member[c]; m < run.first_member[c + 1]; ++m) {
        SdfTree alone;
        alone.numbers = tree.numbers;
        alone.nodes.push_back(tree.nodes[tree.nodes[0].first_child + 1 + run.members[m]]);
        const double value = Reference(alone)(Vec3d(p));
        ASSERT_GE(value, std::sqrt(square) - 1e-5 * (1 + double{max_component(abs(p))}));
      }
    }
}

}  // namespace
}  // namespace penumbra::test
