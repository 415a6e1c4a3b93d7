#include "bake/bake_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "bake/bake_scenes.h"
#include "bake/sample_file.h"
#include "bake/stored_light.h"
#include "base/atomic_file.h"
#include "base/error.h"
#include "geometry/embree_scene.h"
#include "render/render.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::bake {
namespace {

Light rect_light(const Vec3& emission) {
  Light light;
  light.type = LightType::rect;
  light.name = "lamp";
  light.position = {0.3f, 2, -0.8f};
  light.normal = {0, -1, 0};
  light.edge_u = {1, 0, 0}, light.edge_v = {0, 0, 1};
  light.emission = emission;
  return light;
}

Light sphere_light(const Vec3& emission) {
  Light light;
  light.type = LightType::sphere;
  light.name = "bulb";
  light.position = {-1, 1.8f, 0.7f};
  light.radius = 0.3f;
  light.emission = emission;
  return light;
}

/// A glossy floor of 4 m and a plate above it, seen straight from above by a camera each of whose
/// pixels is a texel: 0.1 m.
Scene glossy_floor() {
  Scene scene;
  test::add_quad(scene, {-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  const std::uint32_t plate = test::add_quad(scene, {-0.53f, 0.8f, 0.47f}, {1, 0, 0}, {0, 0, -1});
  scene.objects[plate].receives = false;
  Material& floor = scene.materials[0];
  floor.is_metallic_roughness = true;
  floor.diffuse = {0.7f, 0.5f, 0.3f};
  floor.metallic = 0.7f, floor.roughness = 0.35f;
  scene.lights = {rect_light({6, 5, 4}), sphere_light({4, 6, 9})};
  Camera camera;
  camera.position = {0, 0.5f, 0};  // below the plate
  camera.look_at = {0, 0, 0};
  camera.up = {0, 0, -1};
  camera.ortho_height = 4;
  scene.cameras.push_back(camera);
  finish_scene(scene, "glossy floor");
  scene.ambient = {}, scene.ambient_is_automatic = false;
  return scene;
}

/// What the ray tracer finds by the samples that a bake of `scene` takes for its first chart.
class SameSamples final : public KnownLight {
 public:
  SameSamples(const World& world, std::vector<SampledLight> lights)
      : world_(world), lights_(std::move(lights)) {}
  void irradiances(std::size_t, std::span<const TilePoint>, std::span<float>) const override {}
  void visible_fractions(std::size_t, std::span<const TilePoint>, std::span<float>) const override {
  }
  bool arrivals(std::size_t light, std::span<const TilePoint> points,
                std::span<const std::uint8_t> asked, std::span<LightArrival> out) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (asked[i]) out[i] = arrival(lights_[light], points[i]);
    return true;
  }

 private:
  LightArrival arrival(const SampledLight& light, const TilePoint& point) const {
    std::vector<LightPoint> seen;
    const Vec3 p = point.receiver.position, from = p + point.receiver.normal * 1e-4f;
    const auto n = static_cast<float>(light.samples.size());
    for (const LightSample& s : light.samples) {
      const Vec3 to = normalize(s.position - p);
      const ShadowRay ray{from, to, 0, length(s.position - from) * 0.9999f};
      seen.push_back({to, n * irradiance_of(light, s, p, to), !world_.occluded(ray)});
    }
    return arrival_from(seen, point.shading);
  }

  const World& world_;
  std::vector<SampledLight> lights_;
};

class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    textures_.texel_size = 0.1f;
    samples_.light_samples = 36;
    picture_.width = picture_.height = 40;
    picture_.spp = 1;
    picture_.exposure_ev = 0.0f;
    picture_.shadows.kind = ShadowKind::heckbert_herf;
  }

  std::string file() const { return folder_ / "stored.glb"; }

  std::string bytes_of(const Scene& scene, Store store) {
    const Plan plan = make_plan(scene, textures_);
    const World world(scene, {.cone_tree = false});
    const BakedIrradiance irradiance(world, samples_);
    const LightViews views(scene);
    const DirectLight lights(views);
    const MaterialLookup materials(scene);
    Progress silent;
    const BakeInput input{scene, irradiance, lights, materials, scene.ambient, 0, nullptr, {}};
    return glb_bytes(bake_store(input, irradiance, plan, textures_, store, silent).model);
  }
  Scene stored(const Scene& scene, Store store) {
    write_file(file(), bytes_of(scene, store));
    return load_scene(file());
  }

  Image picture(const Scene& scene, const KnownLight* known) {
    const World world(scene, {.cone_tree = false});
    picture_.known = known;
    Progress silent;
    return render(world, picture_, silent).color;
  }
  Image picture_of_file(const Scene& scene) {
    const StoredLight light(file(), scene);
    return picture(scene, &light);
  }

  void expect_refused(const std::string& bytes, const std::string& what) {
    write_file(file(), bytes);
    try {
      const Scene scene = load_scene(file());
      const StoredLight light(file(), scene);
      ADD_FAILURE() << "not refused: " << what;
    } catch (const InputError& error) {
      const std::string line = error.what();
      EXPECT_THAT(line, ::testing::HasSubstr(what));
      EXPECT_THAT(line, ::testing::StartsWith(file()));
      EXPECT_EQ(line.find('\n'), line.npos);
    }
  }

  test::TemporaryFolder folder_;
  TextureOptions textures_;
  BakeOptions samples_;
  RenderOptions picture_;
};

float brightest(const Image& image) { return *std::ranges::max_element(image.data); }

/// The part of the values that differ by more than `limit` times the brightest.
double differing(const Image& a, const Image& b, float limit) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.data.size(); ++i)
    count += std::abs(a.data[i] - b.data[i]) > limit * brightest(b);
  return static_cast<double>(count) / static_cast<double>(a.data.size());
}

TEST_F(StoreTest, SamplesShadeGlossyTexelsAsRaysToTheSamePointsDo) {
  const Scene scene = glossy_floor();
  const Scene back = stored(scene, Store::samples);
  const Image found = picture_of_file(back);

  const World world(scene, {.cone_tree = false});
  const BakedIrradiance irradiance(world, samples_);
  const Plan plan = make_plan(scene, textures_);
  const World own(back, {.cone_tree = false});
  const SameSamples traced(own, irradiance.sampled_lights(plan.charts.at(0).shape, false));
  const Image expected = picture(back, &traced);
  ASSERT_GT(brightest(expected), 0.5f);
  const Image unshadowed = [&] {
    picture_.shadows.kind = ShadowKind::none;
    return picture(back, nullptr);
  }();
  EXPECT_GT(differing(expected, unshadowed, 0.02f), 0.1);
  // A bit may differ where a shadow's edge runs through a texel's centre.
  EXPECT_LE(differing(found, expected, 1e-3f), 0.005);
}

TEST_F(StoreTest, SamplesComeNearTheRayTracersAreaLights) {
  samples_.light_samples = 256;
  textures_.texel_size = 0.02f;
  const Scene back = stored(glossy_floor(), Store::samples);
  picture_.width = picture_.height = 64;
  const Image found = picture_of_file(back);
  picture_.shadows.kind = ShadowKind::area;
  picture_.shadows.light_samples = 1024;
  EXPECT_LT(differing(found, picture(back, nullptr), 0.03f), 0.01);
}

TEST_F(StoreTest, LightsMayChangeTheirColoursAfterABake) {
  for (const Store store : {Store::visibility, Store::samples}) {
    Scene changed = glossy_floor();
    changed.lights[0].emission = {1, 7, 2}, changed.lights[1].emission = {0, 3, 20};
    const Image expected = picture_of_file(stored(changed, store));
    Scene back = stored(glossy_floor(), store);
    const Image before = picture_of_file(back);
    for (Light& light : back.lights)
      light.emission = light.name == "lamp" ? Vec3{1, 7, 2} : Vec3{0, 3, 20};
    const Image found = picture_of_file(back);
    EXPECT_GT(differing(before, expected, 0.1f), 0.15);
    EXPECT_EQ(differing(found, expected, 1e-4f), 0);
  }
}

TEST_F(StoreTest, VisibilityShowsTheRadianceOfABake) {
  Scene scene = glossy_floor();
  scene.materials[0].metallic = 0, scene.materials[0].roughness = 1;
  samples_.light_samples = 256;
  const Image found = picture_of_file(stored(scene, Store::visibility));
  picture_.shadows.kind = ShadowKind::area;
  picture_.shadows.light_samples = 1024;
  const Scene back = load_scene(file());
  EXPECT_LT(differing(found, picture(back, nullptr), 0.02f), 0.02);
}

TEST_F(StoreTest, HighlightsOfSceneFilesComeBack) {
  Scene scene = glossy_floor();
  Material& floor = scene.materials[0];
  floor.is_metallic_roughness = false;
  floor.specular = {0.2f, 0.3f, 0.4f}, floor.mirror = {0.1f, 0, 0}, floor.roughness = 0.3f;
  const Scene back = stored(scene, Store::visibility);
  const Material& read = back.materials.at(back.instances.at(0).material);
  EXPECT_FALSE(read.is_metallic_roughness);
  EXPECT_EQ(read.diffuse, floor.diffuse);
  EXPECT_EQ(read.specular, floor.specular);
  EXPECT_EQ(read.mirror, floor.mirror);
  EXPECT_EQ(read.roughness, floor.roughness);
}

TEST_F(StoreTest, RasterAndRaysStoreTheSame) {
  samples_.device = BakeDevice::cpu;
  const Image by_cpu = picture_of_file(stored(glossy_floor(), Store::visibility));
  samples_.device = BakeDevice::rays;
  const Image by_rays = picture_of_file(stored(glossy_floor(), Store::visibility));
  EXPECT_LT(differing(by_cpu, by_rays, 0.01f), 0.005);
  const Image bits_by_rays = picture_of_file(stored(glossy_floor(), Store::samples));
  samples_.device = BakeDevice::cpu;
  const Image bits_by_cpu = picture_of_file(stored(glossy_floor(), Store::samples));
  EXPECT_LT(differing(bits_by_cpu, bits_by_rays, 0.01f), 0.005);
}

/// A wall with two sides and a lamp on one of them.
TEST_F(StoreTest, EachSideOfASurfaceHasItsOwn) {
  for (const Store store : {Store::visibility, Store::samples}) {
    Scene scene = glossy_floor();
    scene.materials[0].double_sided = true;
    scene.cameras[0].position = {0, -0.5f, 0};
    scene.cameras[0].up = {0, 0, 1};
    const Scene back = stored(scene, store);
    EXPECT_EQ(back.ambient, Vec3{});
    EXPECT_FALSE(back.ambient_is_automatic);
    EXPECT_EQ(brightest(picture_of_file(back)), 0) << "from below";
    Scene above = back;
    above.cameras = glossy_floor().cameras;
    EXPECT_GT(brightest(picture_of_file(above)), 0.5f);
  }
}

TEST_F(StoreTest, CurvedSurfacesAreShadedAsTheRayTracerDoes) {
  Scene scene = glossy_floor();
  const Material glazed = scene.materials[0];
  const auto ball = static_cast<std::uint32_t>(scene.meshes.size());
  Mesh mesh;
  constexpr int rows = 24, columns = 48;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) {
      const float a = 6.2831853f * static_cast<float>(i) / columns,
                  b = 3.14159265f * static_cast<float>(j) / rows;
      const Vec3 n{std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a)};
      mesh.normals.push_back(n);
      mesh.positions.push_back(Vec3{-1.2f, 0.5f, -0.9f} + n * 0.45f);
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t k = j * (columns + 1) + i, below = k + columns + 1;
      if (j > 0) mesh.indices.insert(mesh.indices.end(), {k, below, k + 1});
      if (j + 1 < rows) mesh.indices.insert(mesh.indices.end(), {k + 1, below, below + 1});
    }
  scene.meshes.push_back(mesh);
  scene.instances.push_back({ball,
                             static_cast<std::uint32_t>(scene.materials.size()),
                             static_cast<std::uint32_t>(scene.objects.size()),
                             -1,
                             {}});
  scene.materials.push_back(glazed);
  scene.materials.back().double_sided = false;
  scene.objects.push_back({"ball"});
  scene.cameras[0].position = {0, 4, 3}, scene.cameras[0].look_at = {-1, 0.4f, -0.6f};
  scene.cameras[0].ortho_height = 2;
  textures_.texel_size = 0.02f;
  samples_.light_samples = 256;
  picture_.width = picture_.height = 64;
  picture_.spp = 4;
  for (const Store store : {Store::visibility, Store::samples}) {
    const Scene back = stored(scene, store);
    picture_.shadows.kind = ShadowKind::heckbert_herf;
    const Image found = picture_of_file(back);
    picture_.shadows.kind = ShadowKind::area;
    picture_.shadows.light_samples = 256;
    EXPECT_LT(differing(found, picture(back, nullptr), 0.05f), 0.02) << static_cast<int>(store);
  }
}

TEST_F(StoreTest, RefusesLightsThatWereNotBaked) {
  const Scene back = stored(glossy_floor(), Store::visibility);
  Scene moved = back;
  moved.lights[0].position.x += 0.1f;
  EXPECT_THAT([&] { StoredLight(file(), moved); },
              ::testing::ThrowsMessage<InputError>(::testing::HasSubstr(
                  "what is seen of the rect light \"lamp\" is not stored in the file")));
  Scene more = back;
  more.lights.push_back(more.lights[0]);
  EXPECT_THROW(StoredLight(file(), more), InputError);
  Scene fewer = back;
  fewer.lights.erase(fewer.lights.begin());
  EXPECT_NO_THROW(StoredLight(file(), fewer));
}

TEST_F(StoreTest, RefusesWhatCannotBeStored) {
  Scene scene = glossy_floor();
  scene.lights[0].type = LightType::segment;
  scene.lights[0].radius = 0.1f;
  EXPECT_THROW(bytes_of(scene, Store::visibility), InputError);
  textures_.supersample = 2;
  EXPECT_THROW(bytes_of(glossy_floor(), Store::samples), InputError);
  textures_.supersample = 1;
  textures_.most_bytes = 1'000;
  textures_.texel_size = 4;
  samples_.light_samples = 60000;
  EXPECT_THAT([&] { bytes_of(glossy_floor(), Store::samples); },
              ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("--texel-size")));
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, text.npos) << from;
  EXPECT_EQ(from.size(), to.size());
  return text.replace(at, from.size(), to);
}

TEST_F(StoreTest, DamagedFilesGetOneLine) {
  textures_.texel_size = 0.5f;
  const std::string bits = bytes_of(glossy_floor(), Store::samples);
  expect_refused(bits.substr(0, bits.size() - 100), "");
  std::string changed = bits;
  changed[changed.find("PNBS") + 200] ^= 4;
  expect_refused(changed, "the stored samples are damaged: their checksum differs");
  expect_refused(replaced(bits, "PNBS", "PNBX"), "they do not begin as samples do");
  expect_refused(replaced(bits, "\"kind\":\"samples\"", "\"kind\":\"sample_\""), "neither");
  expect_refused(replaced(bits, "\"pages\":", "\"pagen\":"), "the sizes of pages are missing");
  expect_refused(replaced(bits, "\"lights\":[{\"dir", "\"lightz\":[{\"dir"), "is missing");
  const std::string fractions = bytes_of(glossy_floor(), Store::visibility);
  changed = fractions;
  changed[changed.find("PNG") + 20] ^= 0x55;
  expect_refused(changed, "lights[0].textures[0]");
  expect_refused(replaced(fractions, "\"textures\":[0]", "\"textures\":[9]"),
                 "its textures are not in the file");
}

TEST_F(StoreTest, AnyBytesOfSamplesAreReadOrRefused) {
  SampleWriter writer(1);
  ChartSight sight;
  SampledLight light;
  light.samples = {{{0, 1, 0}, {0, -1, 0}, 0.5f}, {{1, 1, 0}, {0, -1, 0}, 0.5f}};
  sight.lights.push_back(light);
  sight.bits.emplace_back(6, 2);
  sight.bits[0].set(4, 1, true);
  writer.add({0, 4, 4, false}, 3, 2, sight);
  const std::string bytes = writer.bytes();
  const SampleFile read = parse_samples(bytes, 1, 1);
  ASSERT_EQ(read.charts.size(), 1u);
  EXPECT_EQ(read.lists.at(0).samples.size(), 2u);
  EXPECT_EQ(read.charts[0].bits.at(0)[1], 2) << "texel 4, sample 1 is bit 9";
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(parse_samples(std::string_view(bytes).substr(0, size), 1, 1), std::runtime_error);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (const int flip : {1, 0x80, 0xff}) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      EXPECT_THROW(parse_samples(changed, 1, 1), std::runtime_error) << i;
    }
  EXPECT_THROW(parse_samples(bytes, 2, 1), std::runtime_error);
}

TEST(SampleBits, RowsAndCopiesAreWhatSingleBitsAre) {
  constexpr std::size_t texels = 200, samples = 5;
  SampleBits rows(texels, samples), single(texels, samples);
  std::uint64_t hidden[4] = {0x123456789abcdef0u, ~std::uint64_t{0}, 0, 0xff00ff00ff00ff00u};
  for (std::size_t s = 0; s < samples; ++s) {
    hidden[0] = hidden[0] * 6364136223846793005u + 1;
    rows.set_row(7, 150, s, s == 3 ? nullptr : hidden);
    for (std::size_t i = 0; i < 150; ++i)
      single.set(7 + i, s, s == 3 || !(hidden[i / 64] >> (i % 64) & 1));
  }
  EXPECT_EQ(rows.bytes(), single.bytes());
  SampleBits copied(texels, samples);
  copied.copy(13, rows, 7, 90);
  for (std::size_t i = 0; i < texels; ++i)
    for (std::size_t s = 0; s < samples; ++s)
      EXPECT_EQ(copied.at(i, s), i >= 13 && i < 103 && rows.at(i - 6, s));
}

}  // namespace
}  // namespace penumbra::bake
