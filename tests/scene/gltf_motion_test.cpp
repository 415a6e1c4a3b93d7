#include <gtest/gtest.h>

#include "gltf_file.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

/// A triangle on a node that `path` of animation 0 moves: times 1, 2, 4.
struct Moving {
  std::string path = "translation", between = "LINEAR", node, more;
  std::vector<float> times{1, 2, 4};
  std::vector<float> values{0, 0, 0, 2, 0, 0, 2, 4, 0};
  int components = 3;

  std::string text() const {
    GltfFile file;
    const int positions = file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    const int input = file.accessor(file.view(times), 5126, "SCALAR", times.size());
    const int output = file.accessor(file.view(values), 5126, components == 4 ? "VEC4" : "VEC3",
                                     values.size() / static_cast<std::size_t>(components));
    return file.text(fmt::format(
        R"("meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}}}]}}],"nodes":[{{"mesh":0{}}}],)"
        R"("scenes":[{{"nodes":[0]}}],"animations":[{{"channels":[{{"sampler":0,"target":{{"node":0,"path":"{}"}}}}],)"
        R"("samplers":[{{"input":{},"output":{},"interpolation":"{}"}}]}}{}])",
        positions, node, path, input, output, between, more));
  }
  Scene at(double time) const {
    const TemporaryFolder folder;
    write(folder / "a.gltf", text());
    return read_gltf(folder / "a.gltf", {.time = time});
  }
  Affine pose(double time) const { return at(time).instances[0].world_from_mesh; }
};

void expect_near(const Vec3d& a, const Vec3d& b) {
  EXPECT_LT(length(a - b), 1e-6) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(GltfMotion, TranslationsGoStraight) {
  const Moving m;
  expect_near(m.pose(0).t, {0, 0, 0});
  expect_near(m.pose(1.25).t, {0.5, 0, 0});
  expect_near(m.pose(2).t, {2, 0, 0});
  expect_near(m.pose(3).t, {2, 2, 0});
  expect_near(m.pose(99).t, {2, 4, 0});
  EXPECT_EQ(m.at(0).keyframe_times, (std::vector<double>{1, 4}));
}

TEST(GltfMotion, StepsStandUntilTheNext) {
  Moving m;
  m.between = "STEP";
  expect_near(m.pose(1.99).t, {0, 0, 0});
  expect_near(m.pose(2).t, {2, 0, 0});
  expect_near(m.pose(3.9).t, {2, 0, 0});
}

TEST(GltfMotion, RotationsTakeTheShorterWayAtEvenSpeed) {
  const float h = std::sqrt(0.5f);
  Moving m;
  m.path = "rotation", m.components = 4;
  m.times = {0, 1}, m.values = {0, 0, 0, 1, 0, 0, -h, -h};  // the same as a quarter turn about z
  const double third = std::acos(-1.0) / 6;
  expect_near(m.pose(1.0 / 3).x, {std::cos(third), std::sin(third), 0});
  expect_near(m.pose(1).x, {0, 1, 0});
}

TEST(GltfMotion, CubicsFollowTheirTangents) {
  Moving m;
  m.between = "CUBICSPLINE";
  m.times = {0, 2};
  m.values = {0, 0, 0, 0, 0, 0, 3, 0, 0, /**/ -1, 0, 0, 4, 0, 0, 0, 0, 0};
  const double s = 0.25, r = 1 - s;  // of the way of 2 s
  const double x = r * r * s * 2 * 3 + s * s * ((3 - 2 * s) * 4 - r * 2 * -1.0);
  expect_near(m.pose(0.5).t, {x, 0, 0});
}

TEST(GltfMotion, WhatTheNodeHasBesideStays) {
  Moving m;
  m.node = R"(,"scale":[2,2,2],"translation":[9,9,9])";
  expect_near(m.pose(2).t, {2, 0, 0});
  expect_near(m.pose(2).x, {2, 0, 0});
}

TEST(GltfMotion, WhatIsLeftOutIsSaid) {
  Moving matrix;
  matrix.node = R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1])";
  expect_near(matrix.pose(2).t, {5, 0, 0});
  EXPECT_EQ(matrix.at(2).report.warnings,
            std::vector<std::string>{"nodes placed by a matrix do not move"});
  Moving weights;
  weights.path = "weights";
  EXPECT_EQ(weights.at(2).report.warnings,
            std::vector<std::string>{"motion of \"weights\" is left out"});
  EXPECT_TRUE(weights.at(2).keyframe_times.empty());
  Moving two;
  two.more = R"(,{"channels":[],"samplers":[]})";
  EXPECT_EQ(two.at(2).report.warnings,
            std::vector<std::string>{"of 2 animations the first is shown"});
}

std::string problem(const Moving& m) {
  const std::string message = error_of(m.text());
  const std::size_t begin = message.find("animations");
  return begin == std::string::npos ? message : message.substr(begin, message.rfind(';') - begin);
}

TEST(GltfMotion, DataThatDoNotFitAreRefused) {
  Moving m;
  m.times = {1, 2};
  EXPECT_EQ(problem(m), "animations[0].samplers[0].output: 3 values for 2 keyframes");
  m.times = {1, 2, 2};
  EXPECT_EQ(problem(m), "animations[0].samplers[0].input: time 2 does not follow the one before");
  m.times = {};
  m.values = {};
  EXPECT_NE(problem(m).find("animations[0].samplers[0].input: keyframes need at least one time"),
            std::string::npos)
      << problem(m);
  Moving four;
  four.path = "rotation";
  EXPECT_EQ(problem(four),
            "animations[0].samplers[0].output: this motion has 4 numbers a keyframe, not 3");
  Moving nan;
  nan.values[4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(problem(nan), "animations[0].samplers[0].output: a value is no finite number");
  std::string text = Moving().text();
  text.replace(text.find("\"sampler\":0"), 11, "\"sampler\":7");
  EXPECT_NE(error_of(text).find("animations[0].channels[0].sampler: 7 is no index of a sampler"),
            std::string::npos)
      << error_of(text);
}

}  // namespace
}  // namespace penumbra::test
