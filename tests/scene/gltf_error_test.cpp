// glTF: what is wrong is refused, with its place.
#include <gmock/gmock.h>

#include "base/error.h"
#include "scene/gltf_file.h"
#include "scene/load.h"

namespace penumbra {
namespace {

using test::bare;
using test::error_of;
using test::GltfFile;
using test::one_node;
using testing::ElementsAre;
using testing::IsEmpty;

/// The message without place and remedy.
std::string problem(const std::string& contents) {
  const std::string message = error_of(contents);
  const std::size_t begin = message.find(": "), end = message.rfind("; ");
  return begin == std::string::npos ? message : message.substr(begin + 2, end - begin - 2);
}

std::string glb() {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return file.binary(one_node(R"({"attributes":{"POSITION":0}})"));
}

std::string with_word(std::string file, std::size_t at, const std::string& bytes) {
  return file.replace(at, bytes.size(), bytes);
}

TEST(GltfError, MissingFile) { EXPECT_THROW(read_gltf("/nowhere/a.gltf"), InputError); }

TEST(GltfError, NoJson) {
  EXPECT_EQ(error_of(""),
            "a.gltf:1:1: Syntax error: value, object or array expected; correct it or export the "
            "file again");
  EXPECT_EQ(error_of("{\n  \"asset\": }"),
            "a.gltf:2:12: Syntax error: value, object or array expected; correct it or export the "
            "file again");
  EXPECT_EQ(error_of("[]"), "a.gltf:1:1: a glTF file holds one JSON object; export it again");
  EXPECT_EQ(error_of("rubbish", "a.glb"),
            "a.glb:0: this is no binary glTF file: it does not begin with 'glTF'; copy or export "
            "the file again");
}

TEST(GltfError, JsonNestedTooDeeply) {
  EXPECT_EQ(error_of(R"({"extras":)" + std::string(1000000, '[')),
            "a.gltf:1:266: the JSON is nested deeper than 256 levels; export the file again");
  const std::string deep = std::string(250, '[') + std::string(250, ']');
  EXPECT_EQ(error_of(bare(R"("extras":)" + deep)), "no error");
}

TEST(GltfError, BracketsInStringsDoNotNest) {
  EXPECT_EQ(error_of(bare(R"("extras":"\")" + std::string(1000, '{') + "\"")), "no error");
}

TEST(GltfError, TruncatedBinaryFile) {
  const std::string file = glb();
  EXPECT_EQ(error_of(file.substr(0, 7), "a.glb"),
            "a.glb:7: the file ends within the header of a binary glTF file; copy or export the "
            "file again");
  EXPECT_EQ(error_of(file.substr(0, 100), "a.glb"),
            fmt::format("a.glb:100: the file ends after 100 of {} bytes; copy or export the file "
                        "again",
                        file.size()));
}

TEST(GltfError, EveryTruncationIsRefused) {
  const std::string file = glb();
  for (std::size_t n = 0; n < file.size(); ++n)
    EXPECT_NE(error_of(file.substr(0, n), "a.glb"), "no error") << n;
}

TEST(GltfError, ContradictoryBinaryFile) {
  const std::string file = glb();
  EXPECT_EQ(error_of(with_word(file, 4, std::string("\1\0\0\0", 4)), "a.glb"),
            "a.glb:4: this is version 1 of binary glTF, not 2; export it as glTF 2.0");
  EXPECT_EQ(error_of(with_word(file, 12, std::string("\0\0\0\1", 4)), "a.glb"),
            fmt::format("a.glb:12: a chunk of 16777216 bytes does not fit into the {} that follow; "
                        "copy or export the file again",
                        file.size() - 20));
  EXPECT_EQ(error_of(with_word(file, 16, "BIN "), "a.glb"),
            "a.glb:12: the first chunk is not JSON; copy or export the file again");
  EXPECT_EQ(error_of(with_word(file, 8, std::string("\x10\0\0\0", 4)), "a.glb"),
            "a.glb:16: the file has no JSON chunk; copy or export the file again");
}

TEST(GltfError, PlacesInABinaryFileAreBytes) {
  GltfFile file;
  EXPECT_EQ(error_of(file.binary(R"("scene":1)"), "a.glb"),
            "a.glb:116: scene: there is no scenes[1]: the file has 0; correct it or export the "
            "file again");
}

TEST(GltfError, OtherVersionsOfGltf) {
  EXPECT_EQ(error_of(R"({"asset":{"version":"1.0"},"nodes":{}})"),
            "a.gltf:1:21: asset.version: this is glTF 1.0, not 2.0; convert it to glTF 2.0");
  EXPECT_EQ(problem("{}"), "'asset' is missing");
  EXPECT_EQ(problem(R"({"asset":{"version":2}})"), "asset.version: must be a string");
}

TEST(GltfError, RequiredExtensionsWeDoNotKnow) {
  EXPECT_EQ(error_of(bare(R"("extensionsRequired":["KHR_draco_mesh_compression"])")),
            "a.gltf:1:50: extensionsRequired[0]: KHR_draco_mesh_compression is required but not "
            "supported; re-export without Draco compression");
  EXPECT_EQ(error_of(bare(R"("extensionsRequired":["KHR_texture_transform","EXT_other"])")),
            "a.gltf:1:74: extensionsRequired[1]: EXT_other is required but not supported; "
            "re-export without it");
}

TEST(GltfError, ExtensionsAreNamesInAList) {
  EXPECT_EQ(problem(bare(R"("extensionsRequired":{"a":1})")),
            "extensionsRequired: must be an array");
  EXPECT_EQ(problem(bare(R"("extensionsUsed":[{}])")), "extensionsUsed[0]: must be a string");
}

TEST(GltfError, ExtensionsThatChangeThePictureAreWarnedOf) {
  EXPECT_THAT(
      test::read(bare(R"("extensionsUsed":["KHR_materials_transmission","KHR_materials_ior"])"))
          .report.warnings,
      ElementsAre("KHR_materials_transmission is not supported: transparent surfaces are shown "
                  "opaque"));
}

TEST(GltfError, WrongTypes) {
  EXPECT_EQ(problem(bare(R"("nodes":{})")), "nodes: must be an array");
  EXPECT_EQ(problem(bare(R"("nodes":[1])")), "nodes[0]: must be an object");
  EXPECT_EQ(problem(bare(R"("nodes":[{"name":1}])")), "nodes[0].name: must be a string");
  EXPECT_EQ(problem(bare(R"("nodes":[{"scale":[1,2]}])")), "nodes[0].scale: must have 3 numbers");
  EXPECT_EQ(problem(bare(R"("nodes":[{"scale":[1,2,"3"]}])")), "nodes[0].scale: must be a number");
  EXPECT_EQ(problem(bare(R"("nodes":[{"extensions":7}])")),
            "nodes[0].extensions: must be an object");
  EXPECT_EQ(problem(bare(R"("materials":[{"doubleSided":1}])")),
            "materials[0].doubleSided: must be true or false");
  EXPECT_EQ(problem(bare(R"("materials":[{"alphaMode":"SOLID"}])")),
            "materials[0].alphaMode: 'SOLID' is none of OPAQUE|MASK|BLEND");
  EXPECT_EQ(problem(bare(R"("materials":[{"emissiveFactor":[1,0,-1]}])")),
            "materials[0].emissiveFactor: must not be negative");
  EXPECT_EQ(
      problem(bare(R"("cameras":[{"type":"perspective","perspective":{"yfov":0,"znear":1}}])")),
      "cameras[0].perspective.yfov: must be greater than zero");
  EXPECT_EQ(problem(bare(R"("nodes":[{"translation":[1e999,0,0]}])")), "'1e999' is not a number");
}

TEST(GltfError, WholeNumbersMayBeWrittenAsReals) {
  EXPECT_EQ(problem(bare(R"("scene":0.0,"scenes":[{}])")), "no error");
  EXPECT_EQ(problem(bare(R"("scene":0.5,"scenes":[{}])")),
            "scene: must be a whole number, zero or more");
  EXPECT_EQ(problem(bare(R"("scene":-1,"scenes":[{}])")),
            "scene: must be a whole number, zero or more");
  EXPECT_EQ(problem(bare(R"("scene":4294967296,"scenes":[{}])")),
            "scene: there is no scenes[4294967296]: the file has 1");
}

/// A document with a bufferView of 36 zeros, and the given accessor and primitive.
std::string with_accessor(const std::string& accessor, const std::string& primitive) {
  return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,)" +
         test::base64(std::string(36, '\0')) +
         R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{)" + accessor + "}]," +
         one_node(primitive) + "}";
}

const std::string kVec3 = R"("componentType":5126,"type":"VEC3","count":3)";
const std::string kPosition = R"({"attributes":{"POSITION":0}})";

TEST(GltfError, DataOutOfRange) {
  EXPECT_EQ(problem(with_accessor(R"("bufferView":1,)" + kVec3, kPosition)),
            "accessors[0].bufferView: there is no bufferViews[1]: the file has 1");
  EXPECT_EQ(problem(with_accessor(R"("bufferView":0,"byteOffset":4,)" + kVec3, kPosition)),
            "accessors[0]: 3 elements end at byte 40 of bufferViews[0], which has 36");
  EXPECT_EQ(problem(with_accessor(
                R"("bufferView":0,"componentType":5126,"type":"VEC3","count":9007199254740991)",
                kPosition)),
            "accessors[0]: 9007199254740991 elements end at byte 108086391056891892 of "
            "bufferViews[0], which has 36");
  EXPECT_EQ(problem(with_accessor(R"("bufferView":0,"byteOffset":-4,)" + kVec3, kPosition)),
            "accessors[0].byteOffset: must be a whole number, zero or more");
  EXPECT_EQ(
      problem(with_accessor(R"("bufferView":0,)" + kVec3, R"({"attributes":{"POSITION":7}})")),
      "meshes[0].primitives[0].attributes.POSITION: there is no accessors[7]: the file has 1");
}

TEST(GltfError, ViewsAndBuffersOutOfRange) {
  const std::string buffer = R"("buffers":[{"byteLength":3,"uri":"data:,abc"}],"bufferViews":)";
  EXPECT_EQ(problem(bare(buffer + R"([{"buffer":0,"byteOffset":2,"byteLength":2}])")),
            "bufferViews[0]: bytes 2 to 4 are outside buffers[0], which has 3");
  EXPECT_EQ(problem(bare(buffer + R"([{"buffer":1,"byteLength":2}])")),
            "bufferViews[0].buffer: there is no buffers[1]: the file has 1");
  EXPECT_EQ(problem(bare(buffer + R"([{"buffer":0,"byteLength":1,"byteStride":5}])")),
            "bufferViews[0].byteStride: must be a multiple of 4 from 4 to 252");
  EXPECT_EQ(problem(bare(R"("buffers":[{"byteLength":4,"uri":"data:,abc"}])")),
            "buffers[0]: byteLength is 4, but there are only 3 bytes");
  EXPECT_EQ(problem(bare(R"("buffers":[{"byteLength":4,"uri":"data:abc"}])")),
            "buffers[0].uri: this data URI is malformed");
  EXPECT_EQ(problem(bare(R"("buffers":[{"byteLength":4}])")),
            "buffers[0]: it has no uri, and there is no BIN chunk");
  EXPECT_EQ(error_of(bare(R"("buffers":[{"byteLength":4,"uri":"far.bin"}])")),
            "a.gltf:1:61: buffers[0].uri: 'far.bin' cannot be read; put that file where the uri "
            "says");
}

TEST(GltfError, AttributesOfWrongKind) {
  EXPECT_EQ(problem(with_accessor(R"("bufferView":0,"componentType":5126,"type":"VEC2","count":3)",
                                  kPosition)),
            "meshes[0].primitives[0].attributes.POSITION: must be a VEC3");
  EXPECT_EQ(problem(with_accessor(R"("bufferView":0,"componentType":5125,"type":"VEC3","count":3)",
                                  kPosition)),
            "meshes[0].primitives[0].attributes.POSITION: must not be of 32-bit integers");
  EXPECT_EQ(problem(with_accessor(R"("bufferView":0,)" + kVec3,
                                  R"({"attributes":{"POSITION":0},"indices":0})")),
            "meshes[0].primitives[0].indices: must be a SCALAR of unsigned integers");
}

TEST(GltfError, IndicesAndCountsThatDisagree) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  file.indices({0, 1, 3});
  file.positions({0, 0, 1});
  EXPECT_EQ(problem(file.text(one_node(R"({"attributes":{"POSITION":0},"indices":1})"))),
            "meshes[0].primitives[0].indices: index 2 is 3, but there are 3 vertices");
  EXPECT_EQ(problem(file.text(one_node(R"({"attributes":{"POSITION":0,"NORMAL":2}})"))),
            "meshes[0].primitives[0].attributes.NORMAL: has 1 elements for 3 vertices");
}

TEST(GltfError, OverlappingElements) {
  GltfFile file;
  const int view = file.view(std::vector<float>(9), R"(,"byteStride":8)");
  file.accessor(view, 5126, "VEC3", 3);
  EXPECT_EQ(
      problem(file.text(one_node(kPosition))),
      "accessors[0]: byteStride of bufferViews[0] is 8, less than the 12 bytes of an element");
}

std::string sparse(const std::string& count, const std::string& more) {
  GltfFile file;
  const int at = file.view(std::vector<std::uint8_t>{0, 5});
  const int values = file.view(std::vector<float>(6));
  file.accessor(-1, 5126, "VEC3", 3,
                fmt::format(R"(,"sparse":{{"count":{},"indices":{{"bufferView":{},)"
                            R"("componentType":5121{}}},"values":{{"bufferView":{}}}}})",
                            count, at, more, values));
  return file.text(one_node(kPosition));
}

TEST(GltfError, SparseDataOutOfRange) {
  EXPECT_EQ(problem(sparse("1", "")), "no error");
  EXPECT_EQ(problem(sparse("2", "")),
            "accessors[0].sparse.indices: index 5 is outside the 3 elements of the accessor");
  EXPECT_EQ(problem(sparse("2", R"(,"byteOffset":1)")),
            "accessors[0].sparse.indices: 2 elements end at byte 3 of bufferViews[0], which has 2");
  EXPECT_EQ(problem(sparse("9", "")), "accessors[0].sparse.count: 9 of 3 elements");
  EXPECT_EQ(problem(sparse("4294967297", "")),
            "accessors[0].sparse.count: must be below 2147483648");
}

TEST(GltfError, MemoryIsBoundedByTheFile) {
  const std::string accessor = R"("componentType":5126,"type":"VEC3","count":2147483648)";
  EXPECT_THAT(problem(with_accessor(accessor, kPosition)),
              testing::StartsWith("accessors[0]: this asks for more than 2684"));
}

TEST(GltfError, InstancesAreCountedBeforeTheyAreMade) {
  std::string primitives = kPosition;
  for (int i = 0; i < 3000; ++i) primitives += "," + kPosition;
  std::string nodes = R"({"mesh":0})";
  for (int i = 0; i < 3000; ++i) nodes += R"(,{"mesh":0})";
  GltfFile file;
  file.positions(std::vector<float>(9));
  EXPECT_EQ(problem(file.text(R"("meshes":[{"primitives":[)" + primitives + R"(]}],"nodes":[)" +
                              nodes + "]")),
            "nodes[1332]: the scene has more than 4000000 instances");
}

}  // namespace
}  // namespace penumbra
