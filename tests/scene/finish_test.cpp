#include "scene/finish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "base/error.h"

namespace penumbra {
namespace {

using testing::ElementsAre;

Mesh triangle(Vec3 at = {}, float size = 1) {
  Mesh mesh;
  mesh.name = "tri";
  mesh.positions = {at, at + Vec3{size, 0, 0}, at + Vec3{0, size, 0}};
  mesh.indices = {0, 1, 2};
  return mesh;
}

Scene scene_of(std::vector<Mesh> meshes) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"object"});
  for (Mesh& mesh : meshes) {
    scene.instances.emplace_back().mesh = static_cast<std::uint32_t>(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
  }
  return scene;
}

void append(Mesh& mesh, const Mesh& other) {
  for (const auto i : other.indices)
    mesh.indices.push_back(i + static_cast<std::uint32_t>(mesh.positions.size()));
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
}

std::string error_of(Scene scene) {
  try {
    finish_scene(scene, "a.ply");
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

Vec3 face_normal(const Mesh& mesh) {
  const Vec3 a = mesh.positions[mesh.indices[0]];
  return normalize(cross(mesh.positions[mesh.indices[1]] - a, mesh.positions[mesh.indices[2]] - a));
}

TEST(Finish, DropsTrianglesWithoutArea) {
  Mesh mesh = triangle();
  mesh.positions.push_back({2, 0, 0});
  mesh.indices = {0, 1, 2, 0, 0, 1, 0, 1, 3, 2, 1, 2};
  Scene scene = scene_of({mesh});
  finish_scene(scene, "a.ply");
  EXPECT_THAT(scene.meshes[0].indices, ElementsAre(0, 1, 2));
  EXPECT_EQ(scene.report.dropped_triangles, 3u);
  EXPECT_THAT(scene.report.conversions, ElementsAre("dropped 3 triangles without area"));
}

TEST(Finish, DropsAreaThatIsRoundingAlone) {
  // Corners along one line through no origin, each rounded to float.
  const Vec3d at{1.7, -2.3, 0.9}, along{0.31, 0.77, -0.123};
  Mesh line = triangle();
  line.positions = {Vec3(at), Vec3(at + along), Vec3(at + along * (1.0 / 3))};
  Scene scene = scene_of({line, triangle()});
  finish_scene(scene, "a.ply");
  EXPECT_EQ(scene.report.dropped_triangles, 1u);
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 1u);
}

TEST(Finish, KeepsThinAndSmallTriangles) {
  Mesh thin = triangle();
  thin.positions = {{0, 0, 0}, {1000, 0, 0}, {1000, 1e-5f, 0}};
  Mesh far_plane = triangle({0, 0, 1000}, 1e-5f);
  Scene scene = scene_of({thin, far_plane, triangle({}, 1e-6f)});
  finish_scene(scene, "a.ply");
  EXPECT_EQ(scene.report.dropped_triangles, 0u);
  EXPECT_EQ(scene.meshes.size(), 3u);
}

TEST(Finish, RefusesWhatCannotBeTraced) {
  Mesh nan = triangle();
  nan.name = "x";
  nan.positions.resize(13);
  nan.positions[12].y = NAN;
  EXPECT_EQ(error_of(scene_of({nan})),
            "a.ply: mesh 'x' has a vertex that is not finite (vertex 12); export the model again");
  nan.positions[12].y = -INFINITY;
  nan.name = "";
  EXPECT_EQ(error_of(scene_of({triangle(), nan})),
            "a.ply: mesh 1 has a vertex that is not finite (vertex 12); export the model again");
  EXPECT_EQ(error_of(Scene{}),
            "a.ply: contains no triangle and no sphere; name a file with something to render");
  Mesh point = triangle({}, 0);
  EXPECT_EQ(error_of(scene_of({point})),
            "a.ply: contains no triangle and no sphere; name a file with something to render");
}

TEST(Finish, RefusesBadTransforms) {
  Scene scene = scene_of({triangle()});
  Affine& transform = scene.instances[0].world_from_mesh;
  transform.y = {2, 0, 0};
  EXPECT_EQ(error_of(scene),
            "a.ply: the transform of mesh 'tri' is singular: it flattens the mesh; give it a scale "
            "other than zero on every axis");
  transform.y = {0, INFINITY, 0};
  EXPECT_EQ(error_of(scene),
            "a.ply: the transform of mesh 'tri' is not finite; give it finite numbers");
  transform.y = {0, 1e30, 0};
  EXPECT_EQ(error_of(scene),
            "a.ply: mesh 'tri' reaches beyond 1e+09 metres from the origin; scale the scene down");
  transform.y = {0, 1e-4, 0};
  EXPECT_EQ(error_of(scene), "no error");
}

TEST(Finish, RefusesCamerasAndLightsBeyondAllScenes) {
  Scene scene = scene_of({triangle()});
  scene.cameras.emplace_back();
  scene.cameras[0].name = "eye";
  scene.cameras[0].position = {0, 1, 1e30f};
  EXPECT_EQ(error_of(scene),
            "a.ply: the camera 'eye' lies or reaches beyond 1e+09 metres from the origin; scale "
            "the scene down");
  scene.cameras[0].position = {0, 1, 1e9f};
  EXPECT_EQ(error_of(scene), "no error");
  scene.cameras[0].ortho_height = 1e10f;
  EXPECT_NE(error_of(scene), "no error");
  scene.cameras.clear();
  scene.lights.emplace_back().name = "lamp";
  for (Vec3 Light::*part : {&Light::position, &Light::edge_u, &Light::edge_v}) {
    scene.lights[0].*part = {0, -1e10f, 0};
    EXPECT_EQ(error_of(scene),
              "a.ply: the light 'lamp' lies or reaches beyond 1e+09 metres from the origin; scale "
              "the scene down");
    scene.lights[0].*part = {};
  }
  scene.lights[0].radius = INFINITY;
  EXPECT_NE(error_of(scene), "no error");
}

TEST(Finish, RefusesBadSpheres) {
  Scene scene = scene_of({triangle()});
  scene.spheres.push_back({{0, 0, 0}, -1, 0, 0});
  EXPECT_EQ(error_of(scene),
            "a.ply: a sphere has a centre that is not finite or a radius not above 0; give it "
            "finite numbers and a positive radius");
  scene.spheres[0].radius = 2e9f;
  EXPECT_EQ(error_of(scene),
            "a.ply: a sphere reaches beyond 1e+09 metres from the origin; scale the scene down");
  scene.spheres[0].radius = 1;
  EXPECT_EQ(error_of(scene), "no error");
}

TEST(Finish, SphereAloneIsAScene) {
  Scene scene;
  scene.spheres.push_back({{0, 0, 0}, 1, 0, 0});
  finish_scene(scene, "a.json");
  EXPECT_EQ(scene.spheres.size(), 1u);
}

TEST(Finish, AppliesTransformOfMeshUsedOnce) {
  Scene scene = scene_of({triangle()});
  scene.meshes[0].normals.assign(3, normalize(Vec3{1, 1, 0}));
  scene.instances[0].world_from_mesh = {{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {10, 20, 30}};
  finish_scene(scene, "a.gltf");
  EXPECT_TRUE(scene.instances[0].world_from_mesh.is_identity());
  EXPECT_EQ(scene.meshes[0].positions[1], (Vec3{12, 20, 30}));
  const Vec3 expected = normalize(Vec3{0.5f, 1, 0});  // inverse transpose
  EXPECT_LT(length(scene.meshes[0].normals[0] - expected), 1e-6f);
}

TEST(Finish, MirroringKeepsTheFront) {
  Scene scene = scene_of({triangle()});
  scene.meshes[0].normals.assign(3, Vec3{0, 0, 1});
  scene.instances[0].world_from_mesh.x = {-1, 0, 0};
  finish_scene(scene, "a.gltf");
  EXPECT_EQ(face_normal(scene.meshes[0]), (Vec3{0, 0, 1}));
  EXPECT_EQ(scene.meshes[0].normals[0], (Vec3{0, 0, 1}));
}

TEST(Finish, TrueInstancesKeepTheirTransform) {
  Scene scene = scene_of({triangle()});
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].world_from_mesh.t = {5, 0, 0};
  finish_scene(scene, "a.gltf");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances[1].world_from_mesh.t, (Vec3d{5, 0, 0}));
}

TEST(Finish, RemovesUnusedMeshes) {
  Scene scene = scene_of({triangle(), triangle({7, 0, 0})});
  scene.instances.erase(scene.instances.begin());
  finish_scene(scene, "a.gltf");
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances[0].mesh, 0u);
  EXPECT_EQ(scene.meshes[0].positions[0], (Vec3{7, 0, 0}));
}

TEST(Finish, RepairsNormalsAndTextureCoordinates) {
  Scene scene = scene_of({triangle()});
  scene.meshes[0].normals = {{0, 0, 0}, {0, 3, 0}, {NAN, 0, 0}};
  scene.meshes[0].uv[1] = {{NAN, 1}, {0.5f, 2}, {0, INFINITY}};
  finish_scene(scene, "a.gltf");
  EXPECT_THAT(scene.meshes[0].normals, ElementsAre(Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{0, 0, 1}));
  EXPECT_EQ(scene.meshes[0].uv[1][0].x, 0);
  EXPECT_EQ(scene.meshes[0].uv[1][0].y, 0);
  EXPECT_EQ(scene.meshes[0].uv[1][1].y, 2);
  EXPECT_EQ(scene.meshes[0].uv[1][2].y, 0);
}

TEST(Finish, EmissiveMeshBecomesALightPerPart) {
  Mesh lamps = triangle();
  append(lamps, triangle({10, 0, 0}, 3));
  lamps.name = "lamps";
  lamps.normals.assign(6, Vec3{0, 0, 1});
  lamps.uv[0] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  Scene scene = scene_of({triangle({0, 0, -5}), lamps});
  scene.materials.push_back({});
  scene.materials[1].emission = {0, 7, 0};
  scene.materials[1].double_sided = false;
  scene.instances[1].material = 1;
  scene.lights.emplace_back();
  finish_scene(scene, "a.gltf");

  ASSERT_EQ(scene.meshes.size(), 3u);
  ASSERT_EQ(scene.instances.size(), 3u);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_THAT(scene.report.conversions,
              ElementsAre("the emissive mesh 'lamps' became 2 lights, one per connected part"));
  for (int i = 1; i < 3; ++i) {
    const Light& light = scene.lights[i];
    EXPECT_EQ(light.type, LightType::mesh);
    EXPECT_EQ(light.instance, i);
    EXPECT_EQ(scene.instances[i].mesh_light, i);
    EXPECT_EQ(light.emission, (Vec3{0, 7, 0}));
    EXPECT_FALSE(light.double_sided);
    EXPECT_EQ(scene.meshes[scene.instances[i].mesh].triangle_count(), 1u);
    EXPECT_EQ(scene.meshes[scene.instances[i].mesh].normals.size(), 3u);
  }
  EXPECT_EQ(scene.lights[1].name, "lamps 1");
  EXPECT_EQ(scene.lights[2].name, "lamps 2");
  EXPECT_EQ(scene.lights[2].position, (Vec3{11, 1, 0}));
  EXPECT_EQ(scene.meshes[scene.instances[2].mesh].uv[0][0].x, 3);
  EXPECT_EQ(scene.instances[0].mesh_light, -1);
}

TEST(Finish, LightPositionIsWeightedByArea) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {-6, 0, 0}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  Scene scene = scene_of({mesh});
  scene.materials[0].emission = {1, 1, 1};
  finish_scene(scene, "a.gltf");
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_LT(length(scene.lights[0].position - Vec3{-1, 1, 0}), 1e-6f);  // (1 · 1 − 2 · 2) / 3
  EXPECT_TRUE(scene.lights[0].double_sided);
}

TEST(Finish, EmissionByTextureIsNoLight) {
  Scene scene = scene_of({triangle()});
  scene.materials[0].emission = {1, 1, 1};
  scene.materials[0].emission_map.image = 0;
  finish_scene(scene, "a.gltf");
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.instances[0].mesh_light, -1);
}

TEST(Finish, AnEmissionTextureThatLightsIsALightForEachOfItsColours) {
  Scene scene = scene_of({triangle()});
  Material& material = scene.materials[0];
  material.emission = {2, 3, 4};
  material.emission_map.image = 0;
  material.emission_map_lights = true;
  scene.textures.push_back({"glass", 2, 1, {255, 0, 0, 255, 9, 0, 90, 255}});
  Scene grey = scene, dark = scene;
  finish_scene(scene, "a.gltf");
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(scene.lights[0].emission, (Vec3{2, 0, 0}));
  EXPECT_EQ(scene.lights[1].emission, (Vec3{0, 0, 4}));
  EXPECT_THAT(scene.lights[0].name, ::testing::EndsWith(" (red)"));
  EXPECT_THAT(scene.lights[1].name, ::testing::EndsWith(" (blue)"));
  EXPECT_EQ(scene.instances[0].mesh_light, 0);

  grey.textures[0].rgba = {200, 200, 200, 255, 0, 0, 0, 255};
  finish_scene(grey, "a.gltf");
  ASSERT_EQ(grey.lights.size(), 1u);
  EXPECT_EQ(grey.lights[0].emission, (Vec3{2, 3, 4}));

  dark.textures[0].rgba = {0, 0, 0, 255, 0, 0, 0, 255};
  finish_scene(dark, "a.gltf");
  EXPECT_TRUE(dark.lights.empty());
  EXPECT_EQ(dark.instances[0].mesh_light, -1);
}

TEST(Finish, InstancedEmissiveMeshIsUnshared) {
  Scene scene = scene_of({triangle()});
  scene.materials[0].emission = {1, 1, 1};
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].world_from_mesh.t = {6, 0, 0};
  finish_scene(scene, "a.gltf");
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_NE(scene.instances[0].mesh, scene.instances[1].mesh);
  EXPECT_NEAR(length(scene.lights[0].position - scene.lights[1].position), 6, 1e-5);
  for (const Instance& instance : scene.instances)
    EXPECT_TRUE(instance.world_from_mesh.is_identity());
}

TEST(Finish, ManyPartsStayOneLight) {
  Mesh mesh;
  for (int i = 0; i < 1001; ++i) append(mesh, triangle({2.0f * static_cast<float>(i), 0, 0}));
  mesh.name = "dust";
  Scene scene = scene_of({mesh});
  scene.materials[0].emission = {1, 1, 1};
  finish_scene(scene, "a.gltf");
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_THAT(scene.report.conversions,
              ElementsAre("the emissive mesh 'dust' has 1001 separate parts, more than 1000: kept "
                          "as one light"));
}

TEST(ConnectedParts, JoinsByEqualPositions) {
  Mesh mesh = triangle({5, 0, 0});
  append(mesh, triangle());
  append(mesh, triangle({-1, 0, 0}));  // shares (0, 0, 0) with the second
  append(mesh, triangle({5, 1, 0}));   // shares (5, 1, 0) with the first
  mesh.positions[6 + 1] = {-0.0f, 0, -0.0f};
  EXPECT_THAT(connected_parts(mesh), ElementsAre(0, 1, 1, 0));
}

TEST(ConnectedParts, TakesWellUnderASecondForAMillionTriangles) {
  constexpr std::uint32_t side = 700;
  Mesh mesh;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      append(mesh, triangle({static_cast<float>(x), static_cast<float>(y), 0}));
  const auto begin = std::chrono::steady_clock::now();
  const auto parts = connected_parts(mesh);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0u);
  RecordProperty("seconds", std::to_string(time.count()));
  EXPECT_LT(time.count(), 5);
}

/// Where a world point lands in the picture, [−1, 1] in both directions if it is seen.
Vec2 project(const Camera& camera, const Vec3& p, float aspect) {
  const Vec3 back = normalize(camera.position - camera.look_at);
  const Vec3 right = normalize(cross(camera.up, back)), up = cross(back, right);
  const Vec3 v = p - camera.position;
  const float scale = 1 / (-dot(v, back) * std::tan(camera.vertical_fov / 2));
  return {dot(v, right) * scale / aspect, dot(v, up) * scale};
}

TEST(Defaults, CameraFramesTheSceneAtAnyScale) {
  for (const Vec3 size : {Vec3{1, 1, 1}, Vec3{10, 0.1f, 3}, Vec3{0.2f, 9, 0.2f}, Vec3{0, 1, 1}})
    for (const float scale : {0.001f, 1.0f, 1000.0f}) {
      Mesh mesh = triangle();
      mesh.positions.clear();
      const auto bit = [](int i, int k) { return static_cast<float>((i >> k) & 1); };
      for (int i = 0; i < 8; ++i)
        mesh.positions.push_back((Vec3{5, 6, 7} + size * Vec3(bit(i, 0), bit(i, 1), bit(i, 2))) *
                                 scale);
      Scene scene = scene_of({mesh});
      add_missing_camera_and_light(scene);
      ASSERT_EQ(scene.cameras.size(), 1u);
      float most = 0;
      for (const Vec3& p : mesh.positions) {
        const Vec2 at = project(scene.cameras[0], p, 16.0f / 9);
        most = std::max({most, std::abs(at.x), std::abs(at.y)});
      }
      EXPECT_LT(most, 0.96f);
      EXPECT_GT(most, 0.90f);
    }
}

TEST(Defaults, CameraFramesSpheresAndInstances) {
  Scene scene = scene_of({triangle()});
  scene.instances.push_back(scene.instances[0]);
  scene.instances[1].world_from_mesh.t = {0, 40, 0};
  scene.spheres.push_back({{0, 20, 0}, 3, 0, 0});
  add_missing_camera_and_light(scene);
  const Camera& camera = scene.cameras.at(0);
  const float top = project(camera, {0, 41, 0}, 1).y;
  const float bottom = std::min(project(camera, {0, 0, 0}, 1).y, project(camera, {1, 0, 0}, 1).y);
  EXPECT_NEAR(top, 1 / 1.06, 1e-4);
  EXPECT_NEAR(bottom, -1 / 1.06, 1e-4) << "as much room below as above";
  scene = Scene{};
  scene.spheres.push_back({{1, 2, 3}, 3, 0, 0});
  add_missing_camera_and_light(scene);
  const float half_angle = std::atan(std::tan(scene.cameras.at(0).vertical_fov / 2) / 1.06f);
  EXPECT_NEAR(length(scene.cameras[0].position - Vec3{1, 2, 3}), 3 / std::sin(half_angle), 1e-3);
}

TEST(Defaults, KeyLightGivesIrradiancePiAndCastsSoftShadows) {
  Scene scene = scene_of({triangle({3, 3, 3}, 2)});
  add_missing_camera_and_light(scene);
  ASSERT_EQ(scene.lights.size(), 1u);
  const Light& light = scene.lights[0];
  EXPECT_EQ(light.type, LightType::sphere);
  const float distance = length(light.position - bounds_of(scene).center());
  const float ratio = light.radius / distance;
  constexpr float pi = std::numbers::pi_v<float>;
  EXPECT_NEAR(pi * light.emission.x * ratio * ratio, pi, 1e-3);
  EXPECT_NEAR(ratio, 0.15, 1e-3);
  const Vec2 at = project(scene.cameras[0], light.position, 1);
  EXPECT_LT(at.x, 0) << "left of the middle";
  EXPECT_GT(at.y, 0) << "above the middle";
  EXPECT_THAT(scene.report.conversions,
              ElementsAre("the file has no camera: added one that frames the scene",
                          "the file has no light: added a soft key light near the camera's side"));
}

TEST(Defaults, LightStandsBesideTheFilesOwnCamera) {
  Scene scene = scene_of({triangle({-1, -1, 0}, 2)});
  Camera camera;
  camera.position = {0, 0, 10};
  scene.cameras.push_back(camera);
  add_missing_camera_and_light(scene);
  EXPECT_EQ(scene.cameras.size(), 1u);
  ASSERT_EQ(scene.lights.size(), 1u);
  EXPECT_LT(length(scene.lights[0].position - Vec3{-1.5f, 1.5f, 10}), 0.01f);
  EXPECT_GT(length(scene.lights[0].position - camera.position), scene.lights[0].radius);
  EXPECT_EQ(scene.report.conversions.size(), 1u);
}

TEST(Defaults, LeavesACompleteSceneAlone) {
  Scene scene = scene_of({triangle()});
  scene.cameras.emplace_back();
  scene.lights.emplace_back();
  add_missing_camera_and_light(scene);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_TRUE(scene.report.conversions.empty());
}

TEST(Defaults, LightOfADegenerateCameraIsFinite) {
  Scene scene = scene_of({triangle()});
  Camera camera;
  camera.position = camera.look_at = {0.5f, 0.5f, 0};
  scene.cameras.push_back(camera);
  add_missing_camera_and_light(scene);
  EXPECT_TRUE(is_finite(scene.lights[0].position));
  EXPECT_TRUE(is_finite(scene.lights[0].emission));
}

}  // namespace
}  // namespace penumbra
