// glTF: real models, where they are at hand.
#include <gmock/gmock.h>

#include <filesystem>

#include "scene/load.h"

namespace penumbra {
namespace {

class GltfModels : public testing::Test {
 protected:
  static std::string path(const std::string& name) {
    return std::string(PENUMBRA_SHARED_DIR) + "/models/" + name;
  }
  static bool present(const std::string& name) { return std::filesystem::exists(path(name)); }
  static std::size_t triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.triangle_count();
    return count;
  }
};

TEST_F(GltfModels, Kitchen) {
  if (!present("kitchen.glb")) GTEST_SKIP() << "kitchen.glb is not there";
  const Scene scene = read_gltf(path("kitchen.glb"));
  EXPECT_EQ(scene.meshes.size(), 25u);
  EXPECT_EQ(scene.instances.size(), 25u);
  EXPECT_NEAR(static_cast<double>(triangles(scene)), 86000, 1000);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.cameras[0].name, "camera");
  EXPECT_NEAR(scene.cameras[0].vertical_fov, 0.7347, 1e-4);
  EXPECT_NEAR(scene.cameras[0].position.x, 7.6341, 1e-4);
  const auto emits = [&](const Instance& i) {
    return max_component(scene.materials[i.material].emission) > 0;
  };
  EXPECT_EQ(std::count_if(scene.instances.begin(), scene.instances.end(), emits), 3);
  EXPECT_TRUE(scene.report.warnings.empty());
}

TEST_F(GltfModels, DamagedHelmet) {
  if (!present("DamagedHelmet.glb")) GTEST_SKIP() << "DamagedHelmet.glb is not there";
  const Scene scene = read_gltf(path("DamagedHelmet.glb"));
  EXPECT_EQ(triangles(scene), 46356u / 3);
  ASSERT_EQ(scene.textures.size(), 3u);
  for (const TextureImage& image : scene.textures) {
    EXPECT_EQ(image.width, 2048);
    EXPECT_EQ(image.height, 2048);
  }
  EXPECT_TRUE(scene.materials.at(0).emission_map.used());
  EXPECT_TRUE(scene.report.warnings.empty());
}

TEST_F(GltfModels, CornellBox) {
  if (!present("CornellBox.glb")) GTEST_SKIP() << "CornellBox.glb is not there";
  const Scene scene = read_gltf(path("CornellBox.glb"));
  EXPECT_EQ(scene.objects.size(), 4u);
  EXPECT_EQ(scene.meshes.size(), 7u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  const Camera& camera = scene.cameras[0];
  // The camera's own turn undoes that of the node above it: it looks into the box, upright.
  EXPECT_NEAR(camera.position.z, 4.5, 1e-5);
  EXPECT_NEAR(normalize(camera.look_at - camera.position).z, -1, 1e-5);
  EXPECT_NEAR(camera.up.y, 1, 1e-5);
  EXPECT_NEAR(camera.vertical_fov, 1.0808, 1e-4);
}

}  // namespace
}  // namespace penumbra
