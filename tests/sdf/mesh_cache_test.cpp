// Grids of distances kept in files.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "base/atomic_file.h"
#include "sdf/mesh_grid.h"
#include "sdf/test_meshes.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

using sdf::MeshGrid;

class MeshCache : public testing::Test {
 protected:
  sdf::GridOptions options() const { return {.voxel_size = 0.1, .cache = file_}; }
  MeshGrid make() const { return MeshGrid(mesh_, options()); }

  void expect_same(const MeshGrid& a, const MeshGrid& b) const {
    for (const Vec3& p : points_about({}, 2, 500)) EXPECT_EQ(a.distance(p), b.distance(p));
  }
  /// Another grid is made and written where `bytes` are the file.
  void expect_ignored(const std::string& bytes) const {
    write_file(file_, bytes);
    const MeshGrid grid = make();
    EXPECT_FALSE(grid.was_cached());
    expect_same(grid, MeshGrid(mesh_, {.voxel_size = 0.1}));
    EXPECT_TRUE(make().was_cached());
  }
  void SetUp() override {
    EXPECT_FALSE(sdf::is_cached(mesh_, options()));
    EXPECT_FALSE(make().was_cached());
    whole_ = read_file(file_);
  }

  TemporaryFolder folder_;
  std::string file_ = folder_ / "m.obj.0.distance.vdb";
  Mesh mesh_ = torus_mesh(1, 0.4, 12, 8);
  std::string whole_;
};

TEST_F(MeshCache, GivesTheSameDistances) {
  EXPECT_TRUE(sdf::is_cached(mesh_, options()));
  const MeshGrid again = make();
  EXPECT_TRUE(again.was_cached());
  expect_same(again, MeshGrid(mesh_, {.voxel_size = 0.1}));
  EXPECT_EQ(folder_.count(), 1);
}

TEST_F(MeshCache, IsOfOneMeshAndOneVoxelSize) {
  mesh_.positions[3].y += 0.01f;
  EXPECT_FALSE(sdf::is_cached(mesh_, options()));
  EXPECT_FALSE(make().was_cached());
  EXPECT_TRUE(make().was_cached());
  auto finer = options();
  finer.voxel_size = 0.09;
  EXPECT_FALSE(sdf::is_cached(mesh_, finer));
  EXPECT_FALSE(MeshGrid(mesh_, finer).was_cached());
}

TEST_F(MeshCache, IsIgnoredAndReplacedWhereDamaged) {
  expect_ignored("");
  expect_ignored("no grid");
  expect_ignored(whole_.substr(0, whole_.size() / 2));
  expect_ignored(whole_.substr(1));
  expect_ignored(whole_ + whole_.substr(whole_.size() - 48));
  for (const double at : {0.0, 0.2, 0.5, 0.8, 0.999999}) {
    std::string bytes = whole_;
    bytes[static_cast<std::size_t>(at * static_cast<double>(bytes.size()))] ^= 0x40;
    expect_ignored(bytes);
  }
}

TEST_F(MeshCache, IsLeftOutWhereNothingCanBeWritten) {
  auto nowhere = options();
  nowhere.cache = folder_ / "missing/m.vdb";
  EXPECT_FALSE(MeshGrid(mesh_, nowhere).was_cached());
  nowhere.cache = folder_ / "folder";
  std::filesystem::create_directory(nowhere.cache);
  EXPECT_FALSE(MeshGrid(mesh_, nowhere).was_cached());
  EXPECT_EQ(folder_.count(), 2);
}

TEST_F(MeshCache, SeveralThreadsMayShareIt) {
  std::filesystem::remove(file_);
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) threads.emplace_back([&] { expect_same(make(), make()); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_TRUE(make().was_cached());
  EXPECT_EQ(folder_.count(), 1);
}

}  // namespace
}  // namespace penumbra::test
