#include "report/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/atomic_file.h"
#include "base/cancel.h"
#include "base/error.h"
#include "base/parallel.h"
#include "render/small_scenes.h"
#include "report/reference_file.h"
#include "scene/finish.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::report {
namespace {

const std::string oracle = PENUMBRA_SOURCE_DIR "/tests/data/oracle/";

Scene oracle_scene(const std::string& name) { return load_scene(oracle + name + ".json"); }

class ErrorEstimate : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ErrorEstimate,
                         ::testing::Values("three-spheres", "sphere-field", "slats", "table"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(ErrorEstimate, IsWhatAVeryLongRunFinds) {
  const Scene scene = oracle_scene(GetParam());
  const World world(scene);
  const ReferenceOptions options{32, 24, 0, 0.002f, 0};
  const ReferencePoints points(world, options.target, options.seed);
  ShadowCounts counts;
  double squares = 0, estimates = 0;
  int mixed = 0, beyond_three = 0;
  std::vector<PointReference> found;
  std::vector<double> truth;
  const auto receivers = receivers_of(world, options);
  ASSERT_GT(receivers.size(), 300u);
  // 12 other runs: their mean is three times as exact as one.
  std::vector<ReferencePoints> others;
  for (std::uint32_t i = 0; i < 12; ++i) others.emplace_back(world, options.target, 1000 + i);
  for (const PixelReceiver& p : receivers)
    for (std::size_t light = 0; light < scene.lights.size(); ++light) {
      const PointReference one =
          points.at(p.receiver, light, p.pixel, ReferencePoints::points_at_edges, counts);
      EXPECT_LT(one.standard_error, options.target);
      double mean = 0;
      for (const ReferencePoints& other : others)
        mean +=
            other.at(p.receiver, light, p.pixel, ReferencePoints::first_points, counts).fraction /
            24;
      const double error = one.fraction - mean;
      if (one.fraction == 0 || one.fraction == 1) {
        EXPECT_NEAR(mean, one.fraction, 0.006) << "pixel " << p.pixel;
        continue;
      }
      ++mixed;
      squares += error * error;
      estimates += one.standard_error * one.standard_error;
      beyond_three += std::abs(error) > 3 * one.standard_error;
    }
  ASSERT_GT(mixed, 30);
  const double ratio = std::sqrt(squares / estimates);
  // The root of the sum of 100 and more squares is known to a tenth.
  EXPECT_NEAR(ratio, 1, 0.2) << mixed;
  EXPECT_LE(beyond_three, std::max(3, mixed / 50));
}

Scene small_scene() {
  Scene scene;
  const std::uint32_t gray = add_material(scene, diffuse_material({0.5f, 0.5f, 0.5f}));
  add_floor(scene, gray);
  add_sphere(scene, {0, 1, 0}, 0.5f, gray);
  add_sphere_light(scene, {0, 4, 0}, 0.5f, 10);
  add_camera(scene, {0, 3, 5}, {0, 0.3f, 0}, 0.9f);
  finish_scene(scene, "");
  return scene;
}

const ReferenceOptions small_options{40, 30, 0, 0.002f, 0};

Reference completed(const World& world, Reference reference) {
  Progress progress;
  complete_reference(
      world, small_options, reference, [](const Reference&) {}, progress);
  return reference;
}

void expect_same(const Reference& a, const Reference& b) {
  EXPECT_EQ(a.surface, b.surface);
  EXPECT_EQ(a.tiles, b.tiles);
  for (std::size_t i = 0; i < a.at.size(); ++i) {
    ASSERT_EQ(a.at[i].fraction, b.at[i].fraction) << i;
    ASSERT_EQ(a.at[i].points, b.at[i].points) << i;
  }
}

TEST(Reference, ReachesItsTargetWithoutAnyWorkWhereThereIsLight) {
  const Scene scene = small_scene();
  const World world(scene);
  const Reference r = completed(world, empty_reference(small_options, 1));
  const ReferenceQuality q = quality_of(r, small_options.target);
  EXPECT_GE(q.share_within, 0.999);
  std::size_t lit = 0, dark = 0, sky = 0;
  for (std::size_t pixel = 0; pixel < r.pixels(); ++pixel) {
    sky += r.surface[pixel] == 0;
    lit += r.surface[pixel] && r.point(0, pixel).points == 0;
    dark += r.surface[pixel] && r.point(0, pixel).fraction == 0;
  }
  EXPECT_GT(lit, r.pixels() / 4);
  EXPECT_GT(dark, 20u);
  EXPECT_GT(sky, 0u);
}

TEST(Reference, GoesOnWhereItWasStopped) {
  const Scene scene = small_scene();
  const World world(scene);
  const Reference whole = completed(world, empty_reference(small_options, 1));
  Reference part = empty_reference(small_options, 1);
  Reference saved;
  Progress progress;
  // Asked to stop when the first save comes.
  class StopSoon : public Progress {
    void advance(std::uint64_t) override {
      if (++tiles == 3) cancel_requested = true;
    }
    std::atomic<int> tiles{0};
  } stop;
  EXPECT_THROW(complete_reference(
                   world, small_options, part, [&](const Reference& r) { saved = r; }, stop),
               Cancelled);
  cancel_requested = false;
  const auto done = std::count(saved.tiles.begin(), saved.tiles.end(), 1);
  EXPECT_GE(done, 2);
  EXPECT_LT(done, static_cast<long>(saved.tiles.size()));
  std::size_t tiles = 0;
  class Count : public Progress {
   public:
    explicit Count(std::size_t& n) : n_(n) {}
    void advance(std::uint64_t steps) override { n_ += steps; }

   private:
    std::size_t& n_;
  };
  const ThreadLimit one(1);
  Count count(tiles);
  complete_reference(
      world, small_options, saved, [](const Reference&) {}, count);
  EXPECT_EQ(tiles, saved.tiles.size() - static_cast<std::size_t>(done));
  expect_same(saved, whole);
}

class ReferenceFile : public ::testing::Test {
 protected:
  ReferenceFile() : scene(small_scene()), world(scene), file(folder / "reference.bin") {
    reference = completed(world, empty_reference(small_options, 1));
    reference.color = Image(40, 30, 3);
    reference.color.data[7] = 0.25f;
    save_reference(file, 5, reference);
  }
  Reference read = empty_reference(small_options, 1);
  test::TemporaryFolder folder;
  Scene scene;
  World world;
  std::string file;
  Reference reference;
};

TEST_F(ReferenceFile, GivesBackWhatWasSaved) {
  ASSERT_EQ(load_reference(file, 5, read), FileState::usable);
  expect_same(read, reference);
  EXPECT_EQ(read.color.data, reference.color.data);
  EXPECT_TRUE(read.complete());
}

TEST_F(ReferenceFile, IsNotTakenForAnother) {
  EXPECT_EQ(load_reference(file, 6, read), FileState::stale);
  EXPECT_EQ(load_reference(folder / "none", 5, read), FileState::absent);
  RenderOptions picture;
  const std::uint64_t key = reference_key(scene, small_options, picture);
  ReferenceOptions larger = small_options;
  larger.width = 41;
  EXPECT_NE(reference_key(scene, larger, picture), key);
  Scene moved = scene;
  moved.lights[0].position.x += 0.001f;
  EXPECT_NE(reference_key(moved, small_options, picture), key);
  picture.spp = 7;
  EXPECT_NE(reference_key(scene, small_options, picture), key);
}

TEST_F(ReferenceFile, TellsAnyDamage) {
  const std::string whole = read_file(file);
  for (const std::size_t at :
       {std::size_t{3}, std::size_t{17}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    std::string text = whole;
    text[at] = static_cast<char>(text[at] ^ 4);
    write_file(file, text);
    EXPECT_EQ(load_reference(file, 5, read), FileState::damaged) << "byte " << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole.size() - 1}) {
    write_file(file, whole.substr(0, size));
    EXPECT_EQ(load_reference(file, 5, read), FileState::damaged) << size << " bytes";
  }
  EXPECT_EQ(read.at[0].points, 0u);
}

}  // namespace
}  // namespace penumbra::report
