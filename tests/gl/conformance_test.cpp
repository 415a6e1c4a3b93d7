// Every shape and operator: the shader's field equals the processor's.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "base/atomic_file.h"
#include "gl/driver.h"
#include "gl/program.h"
#include "gl/target.h"
#include "render/gl/field_program.h"
#include "scene/load.h"
#include "sdf/convert.h"
#include "sdf/field.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

constexpr int kSide = 32;  // points: its square

struct Case {
  const char* name;
  const char* root;
};

#define BALL R"({"shape":"sphere","center":[0.2,0.1,0],"radius":0.5})"
#define BRICK R"({"shape":"box","center":[-0.1,0,0.2],"half_size":[0.5,0.3,0.4]})"

constexpr Case cases[] = {
    {"sphere", BALL},
    {"box", BRICK},
    {"round_box", R"({"shape":"round_box","half_size":[0.5,0.3,0.4],"radius":0.1})"},
    {"ellipsoid", R"({"shape":"ellipsoid","center":[0.1,0,0],"radii":[0.7,0.3,0.45]})"},
    {"torus", R"({"shape":"torus","major_radius":0.6,"minor_radius":0.15})"},
    {"capped_torus",
     R"({"shape":"capped_torus","aperture_deg":110,"major_radius":0.6,"minor_radius":0.15})"},
    {"capsule", R"({"shape":"capsule","from":[-0.4,0.1,0],"to":[0.5,0.2,0.3],"radius":0.2})"},
    {"cylinder", R"({"shape":"cylinder","center":[0,0.1,0],"half_height":0.5,"radius":0.3})"},
    {"capped_cone",
     R"({"shape":"capped_cone","half_height":0.4,"radius_bottom":0.5,"radius_top":0.2})"},
    {"cone", R"({"shape":"cone","apex":[0,0.5,0],"angle_deg":28,"height":0.9})"},
    {"plane", R"({"shape":"plane","normal":[1,2,0.5],"offset":0.2})"},
    {"hexagonal_prism", R"({"shape":"hexagonal_prism","radius":0.4,"half_height":0.3})"},
    {"octahedron", R"({"shape":"octahedron","center":[0,0,0.1],"radius":0.6})"},
    {"link", R"({"shape":"link","half_length":0.2,"major_radius":0.3,"minor_radius":0.1})"},
    {"extrusion circle",
     R"({"shape":"extrusion","profile":{"shape":"circle","radius":0.4},"half_height":0.3})"},
    {"extrusion box",
     R"({"shape":"extrusion","profile":{"shape":"box","half_size":[0.4,0.2]},"half_height":0.3})"},
    {"extrusion polygon", R"({"shape":"extrusion","half_height":0.3,"profile":{"shape":"polygon",
        "vertices":[[-0.5,-0.4],[0.5,-0.4],[0.5,0.4],[0,0],[-0.5,0.4]]}})"},
    {"revolution circle",
     R"({"shape":"revolution","profile":{"shape":"circle","radius":0.2},"offset":0.4})"},
    {"revolution box",
     R"({"shape":"revolution","profile":{"shape":"box","half_size":[0.1,0.3]},"offset":0.4})"},
    {"revolution polygon", R"({"shape":"revolution","profile":{"shape":"polygon",
        "vertices":[[0.1,-0.4],[0.5,0],[0.1,0.4]]}})"},
    {"union", R"({"op":"union","children":[)" BALL "," BRICK "]}"},
    {"intersection", R"({"op":"intersection","children":[)" BALL "," BRICK "]}"},
    {"difference", R"({"op":"difference","children":[)" BRICK "," BALL "]}"},
    {"smooth_union", R"({"op":"smooth_union","k":0.2,"children":[)" BALL "," BRICK "," BALL "]}"},
    {"smooth_intersection",
     R"({"op":"smooth_intersection","k":0.2,"children":[)" BALL "," BRICK "]}"},
    {"smooth_difference", R"({"op":"smooth_difference","k":0.2,"children":[)" BRICK "," BALL "]}"},
    {"smooth_union of k 0", R"({"op":"smooth_union","k":0,"children":[)" BALL "," BRICK "]}"},
    {"onion", R"({"op":"onion","thickness":0.05,"child":)" BALL "}"},
    {"round", R"({"op":"round","radius":0.1,"child":)" BRICK "}"},
    {"displace", R"({"op":"displace","amplitude":0.05,"frequency":[9,7,5],"child":)" BALL "}"},
    {"translate", R"({"op":"translate","offset":[0.3,-0.2,0.1],"child":)" BRICK "}"},
    {"rotate", R"({"op":"rotate","rotate_deg":[20,50,-35],"child":)" BRICK "}"},
    {"scale", R"({"op":"scale","factor":1.5,"child":)" BRICK "}"},
    {"scale unevenly", R"({"op":"scale","factor":[1.5,0.5,-0.8],"child":)" BALL "}"},
    {"mirror", R"({"op":"mirror","axes":"xz","child":)" BALL "}"},
    {"repeat", R"({"op":"repeat","spacing":[1.2,0,1.4],"child":)" BRICK "}"},
    {"repeat to a limit",
     R"({"op":"repeat","spacing":[0.5,0.9,0],"limit":[1,0,0],"child":)" BALL "}"},
    {"repeat of repeat", R"({"op":"repeat","spacing":[2,0,0],"child":{"op":"repeat",
        "spacing":[0,0.9,0],"limit":[0,1,0],"child":{"op":"rotate","rotate_deg":[0,0,30],
        "child":)" BRICK "}}}"},
    {"repeat of repeat on all sides", R"({"op":"repeat","spacing":[2,2,2],"limit":[1,1,1],"child":
        {"op":"repeat","spacing":[0.9,0.9,0.9],"limit":[1,1,1],"child":{"op":"rotate",
        "rotate_deg":[0,20,30],"child":)" BRICK "}}}"},
    {"twist", R"({"op":"twist","rate":1.5,"child":)" BRICK "}"},
    {"bend", R"({"op":"bend","rate":0.9,"child":)" BRICK "}"},
    {"elongate", R"({"op":"elongate","half_size":[0.2,0.1,0],"child":)" BALL "}"},
    {"union of slopes",
     R"({"op":"union","children":[{"op":"twist","rate":2,"child":)" BRICK "}," BALL "]}"}};

std::string scene_text(const std::string& root, const std::string& others = "") {
  return R"({"camera":{"position":[0,0,5],"look_at":[0,0,0]},
      "materials":{"a":{"diffuse":[1,1,1]}},"objects":[)" +
         others + R"({"type":"sdf","material":"a","root":)" + root + "}]}";
}

Scene scene_of(const std::string& text) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "scene.json";
  write_file(file, text);
  return load_scene(file);
}

std::vector<Vec3> some_points() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> in(-1.6f, 1.6f);
  std::vector<Vec3> points(kSide * kSide);
  for (Vec3& p : points) p = {in(random), in(random), in(random)};
  return points;
}

// The shader's field at points: the generated text and a main of its own.
std::vector<float> shader_field(const FieldText& field, const std::vector<Vec3>& points) {
  return testing::drawn([&] {
    gl::Program program(
        "#version 300 es\nprecision highp float;\nprecision highp int;\nuniform highp sampler2D "
        "t;\n" +
        field.generated +
        "out vec4 d;\nvoid main() {\n"
        "  d = vec4(pnb_map(texelFetch(t, ivec2(gl_FragCoord.xy), 0).xyz));\n}\n");
    const SceneTextures textures(field, {}, 4096);
    textures.give(program);
    gl::Texture texture(kSide, kSide);
    std::vector<float> texels;
    for (const Vec3& p : points) texels.insert(texels.end(), {p.x, p.y, p.z, 0});
    texture.write(kSide, kSide, texels);
    texture.bind(1);
    program.set("t", 1);
    const gl::Target target(kSide, kSide, 1);
    target.use();
    program.draw(kSide, kSide);
    std::vector<float> values;
    const std::vector<float> pixels = target.read(0, kSide, kSide);
    for (std::size_t i = 0; i < pixels.size(); i += 4) values.push_back(pixels[i]);
    return values;
  });
}

void expect_same_field(const Scene& scene, const std::vector<Vec3>& points = some_points(),
                       double tolerance = 5e-6, int most_far = 0) {
  std::vector<float> expected(points.size());
  const sdf::MeshDistances meshes = sdf::mesh_distances({.voxel_size = 0.04, .keep_files = false});
  sdf::FieldOptions options;
  options.mesh_distance = meshes;
  sdf::Field(scene, options).distance(points, expected);
  const std::vector<float> found = shader_field(field_text(scene, true, meshes), points);
  ASSERT_EQ(found.size(), expected.size());
  int far = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!(std::abs(found[i] - expected[i]) <= tolerance)) ++far, last = i;
  EXPECT_LE(far, most_far) << found[last] << " for " << expected[last] << " at " << points[last].x
                           << ' ' << points[last].y << ' ' << points[last].z;
}

class Conformance : public testing::GlTest {};

TEST(ConformanceCases, HaveEveryShapeAndOperator) {
  std::set<SdfOp> seen;
  for (const Case& c : cases) {
    const Scene scene = scene_of(scene_text(c.root));
    for (const SdfNode& node : scene.sdfs[0].nodes) seen.insert(node.op);
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(sdf_op_count));
}

TEST_F(Conformance, FieldsAreEqual) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    expect_same_field(scene_of(scene_text(c.root)));
  }
}

TEST_F(Conformance, WholeScenesAreEqual) {
  expect_same_field(
      scene_of(scene_text(BALL, R"({"type":"sphere","center":[-1,0,0],"radius":0.4,"material":"a"},
      {"type":"box","min":[0.5,-1,0],"max":[1,-0.5,1],"material":"a"},
      {"type":"quad","corner":[-1,-1,1],"edge_u":[2,0,0],"edge_v":[0.4,0,-2],"material":"a"},
      {"type":"polygon","vertices":[[0,1,0],[1,1,0],[1,1,1],[0.6,1,0.3]],"material":"a"},)")));
}

// A ball of 400 triangles; `holes`: without some of them.
std::string ball_of_triangles(bool holes) {
  constexpr int across = 20, down = 10;
  std::string text;
  for (int j = 0; j <= down; ++j)
    for (int i = 0; i < across; ++i) {
      const double u = i * 2 * std::numbers::pi / across, v = j * std::numbers::pi / down;
      text += fmt::format("v {} {} {}\n", std::sin(v) * std::cos(u), std::cos(v),
                          std::sin(v) * std::sin(u));
    }
  for (int j = 0; j < down; ++j)
    for (int i = 0; i < across; ++i) {
      const int a = j * across + i + 1, b = j * across + (i + 1) % across + 1;
      if (holes && (i + 3 * j) % 17 == 0) continue;
      if (j > 0) text += fmt::format("f {} {} {}\n", a, b, b + across);
      if (j + 1 < down) text += fmt::format("f {} {} {}\n", a, b + across, a + across);
    }
  return text;
}

// Near the surface, within the voxels around it and far away.
std::vector<Vec3> points_about_a_ball() {
  std::vector<Vec3> points = some_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float size = i % 4 == 0   ? 0.6f + 0.001f * static_cast<float>(i)
                       : i % 4 == 1 ? 0.97f + 0.00006f * static_cast<float>(i)
                                    : 0;
    if (size > 0) points[i] = normalize(points[i]) * (0.7f * size);
  }
  return points;
}

// The shader's grids keep 17 bits of their values, and know signs about holes less exactly.
TEST_F(Conformance, MeshesAreEqual) {
  for (const bool holes : {false, true}) {
    SCOPED_TRACE(holes);
    const test::TemporaryFolder folder;
    write_file(folder / "ball.obj", ball_of_triangles(holes));
    write_file(folder / "scene.json", scene_text(BRICK, R"({"type": "mesh", "file": "ball.obj",
        "material": "a", "transform": {"rotate_deg": [10, 20, 30], "scale": 0.7}}, {"type": "mesh",
        "file": "ball.obj", "material": "a", "transform": {"translate": [0.9, 0.8, 0],
        "scale": [0.2, 0.3, 0.2]}},)"));
    expect_same_field(load_scene(folder / "scene.json"), points_about_a_ball(), 2e-5,
                      holes ? kSide * kSide / 100 : 0);
  }
}

TEST_F(Conformance, DeepTreesAreWritten) {
  std::string root = BALL;
  for (int i = 0; i < 1000; ++i)
    root = R"({"op":"translate","offset":[0.001,0,0],"child":)" + root + "}";
  expect_same_field(scene_of(scene_text(root)));
}

}  // namespace
}  // namespace penumbra
