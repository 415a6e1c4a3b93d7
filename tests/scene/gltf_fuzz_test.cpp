// glTF: no bytes make the reader crash, hang or read what is not there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "base/error.h"
#include "scene/gltf_file.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using Random = std::mt19937;

/// A file that uses every part of the reader.
std::string everything() {
  test::GltfFile file;
  const int base =
      file.view(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, R"(,"byteStride":12)");
  const int at = file.view(std::vector<std::uint8_t>{1, 2});
  const int values = file.view(std::vector<float>{7, 7, 7, 8, 8, 8});
  file.accessor(base, 5126, "VEC3", 4,
                fmt::format(R"(,"sparse":{{"count":2,"indices":{{"bufferView":{},)"
                            R"("componentType":5121}},"values":{{"bufferView":{}}}}})",
                            at, values));
  file.indices({0, 1, 2, 3});
  file.accessor(file.view(std::vector<std::int8_t>(16), R"(,"byteStride":4)"), 5120, "VEC3", 4,
                R"(,"normalized":true)");
  file.accessor(file.view(std::vector<float>(8)), 5126, "VEC2", 4);
  return file.binary(
      R"("extensionsUsed":["EXT_lights_area"],"extensionsRequired":["KHR_lights_punctual"],)"
      R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1,2],"mesh":0,"scale":[1,2,3]},)"
      R"({"camera":0,"extensions":{"KHR_lights_punctual":{"light":0}},"extras":{"radius":1}},)"
      R"({"rotation":[0,0,1,0],"extensions":{"EXT_lights_area":{"light":0}}}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":2,"TEXCOORD_0":3},)"
      R"("indices":1,"mode":5,"material":0}]}],"cameras":[{"type":"perspective",)"
      R"("perspective":{"yfov":0.7,"znear":0.1}}],"materials":[{"alphaMode":"MASK",)"
      R"("emissiveFactor":[1,1,1],"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],)"
      R"("textures":[{"source":0,"sampler":0}],"samplers":[{"wrapS":33071}],)"
      R"("images":[{"bufferView":0}],"extensions":{"KHR_lights_punctual":{"lights":[)"
      R"({"type":"spot","intensity":5,"spot":{"innerConeAngle":0.1}}]},)"
      R"("EXT_lights_area":{"lights":[{"type":"rect","size":2}]}})");
}

std::size_t below(Random& random, std::size_t n) { return random() % n; }

/// Something that JSON cares about, or anything.
std::string some_bytes(Random& random) {
  static const std::string words[] = {
      "0",  "-1", "4294967295",       "1e308", "null", "[]", "{}",  "\"\"",
      "\"", ",",  "9007199254740991", "2.5",   "[",    "}",  "true"};
  if (below(random, 2) == 0) return words[below(random, std::size(words))];
  return std::string(1, static_cast<char>(random()));
}

void mutate(std::string& file, Random& random) {
  const std::size_t at = below(random, file.size());
  switch (below(random, 5)) {
    case 0:
      file[at] = static_cast<char>(random());
      break;
    case 1:
      file[at] = static_cast<char>('0' + below(random, 10));
      break;
    case 2:
      file.erase(at, 1 + below(random, 8));
      break;
    case 3:
      file.insert(at, some_bytes(random));
      break;
    default: {
      const std::string bytes = some_bytes(random);
      file.replace(at, bytes.size(), bytes);
    }
  }
}

/// Makes lengths in the header fit again, so that mutations get past it.
void repair_lengths(std::string& file) {
  const std::size_t bin = file.rfind(std::string("BIN\0", 4));
  if (file.size() < 32 || bin == std::string::npos || bin < 24) return;
  const auto put = [&](std::size_t at, std::size_t n) {
    for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<char>(n >> 8 * i);
  };
  put(8, file.size());
  put(12, bin - 4 - 20);
  put(bin - 4, file.size() - bin - 4);
}

/// True if the file was read, false if it was refused; anything else fails the test.
bool reads(const std::string& path, const std::string& contents) {
  test::write(path, contents);
  try {
    read_gltf(path);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// PENUMBRA_FUZZ_RUNS sets how many mutations are tried.
int runs() {
  const char* value = std::getenv("PENUMBRA_FUZZ_RUNS");
  return value ? std::atoi(value) : 2000;
}

TEST(GltfFuzz, TheUnchangedFileIsRead) {
  const Scene scene = test::read(everything(), "a.glb");
  EXPECT_EQ(scene.meshes.at(0).triangle_count(), 2u);
  EXPECT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.lights.size(), 2u);
}

TEST(GltfFuzz, MutatedFilesAreReadOrRefused) {
  const test::TemporaryFolder folder;
  const std::string original = everything();
  Random random(7);
  int read = 0;
  const int total = runs();
  for (int i = 0; i < total; ++i) {
    std::string file = original;
    for (std::size_t n = 1 + below(random, 3); n > 0; --n) mutate(file, random);
    if (below(random, 8) != 0) repair_lengths(file);
    read += reads(folder / "a.glb", file);
  }
  EXPECT_GT(read, total / 50);
  EXPECT_LT(read, total * 9 / 10);
}

TEST(GltfFuzz, RandomBytesAreRefused) {
  const test::TemporaryFolder folder;
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    std::string bytes = i % 2 ? "glTF" : "";
    for (std::size_t n = below(random, 200); n > 0; --n) bytes += static_cast<char>(random());
    EXPECT_FALSE(reads(folder / "a.glb", bytes));
    EXPECT_FALSE(reads(folder / "a.gltf", bytes));
  }
}

}  // namespace
}  // namespace penumbra
