#include "scene/gltf_file.h"

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "scene/load.h"
#include "support/temporary_folder.h"

namespace penumbra::test {
namespace {

std::string joined(const std::string& list, const std::string& item) {
  return list.empty() ? item : list + ',' + item;
}

std::string word(std::size_t n) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(n >> 8 * i & 0xff);
  return bytes;
}

}  // namespace

std::string base64(const std::string& bytes) {
  static const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

int GltfFile::view(const std::string& bytes, const std::string& more) {
  while (bytes_.size() % 4 != 0) bytes_ += '\0';
  views_ = joined(views_, fmt::format(R"({{"buffer":0,"byteOffset":{},"byteLength":{}{}}})",
                                      bytes_.size(), bytes.size(), more));
  bytes_ += bytes;
  return view_count_++;
}

int GltfFile::accessor(int view, int component_type, const char* type, std::size_t count,
                       const std::string& more) {
  const std::string where = view < 0 ? "" : fmt::format(R"("bufferView":{},)", view);
  accessors_ =
      joined(accessors_, fmt::format(R"({{{}"componentType":{},"type":"{}","count":{}{}}})", where,
                                     component_type, type, count, more));
  return accessor_count_++;
}

int GltfFile::positions(const std::vector<float>& numbers) {
  return accessor(view(numbers), 5126, "VEC3", numbers.size() / 3);
}

int GltfFile::indices(const std::vector<std::uint16_t>& numbers) {
  return accessor(view(numbers), 5123, "SCALAR", numbers.size());
}

std::string GltfFile::json(const std::string& members, const std::string& uri) const {
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{}{}}}],"bufferViews":[{}],)"
      R"("accessors":[{}],{}}})",
      bytes_.size(), uri, views_, accessors_, members);
}

std::string GltfFile::text(const std::string& members) const {
  return json(members, R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes_) + '"');
}

std::string GltfFile::binary(const std::string& members) const {
  std::string document = json(members, ""), data = bytes_;
  while (document.size() % 4 != 0) document += ' ';
  while (data.size() % 4 != 0) data += '\0';
  return "glTF" + word(2) + word(28 + document.size() + data.size()) + word(document.size()) +
         "JSON" + document + word(data.size()) + std::string("BIN\0", 4) + data;
}

std::string one_node(const std::string& primitives) {
  return R"("meshes":[{"name":"m","primitives":[)" + primitives +
         R"(]}],"nodes":[{"mesh":0}],"scenes":[{"nodes":[0]}])";
}

std::string triangle_with(const std::string& members, const std::string& primitive_members) {
  GltfFile file;
  file.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  return file.text(one_node(R"({"attributes":{"POSITION":0})" + primitive_members + "}") +
                   (members.empty() ? "" : "," + members));
}

std::string bare(const std::string& members) {
  return R"({"asset":{"version":"2.0"},)" + members + "}";
}

void write(const std::string& path, const std::string& contents) {
  // Some file systems wait for the disk when a file is written over.
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << contents;
}

Scene read(const std::string& contents, const std::string& name) {
  const TemporaryFolder folder;
  write(folder / name, contents);
  return read_gltf(folder / name);
}

std::string error_of(const std::string& contents, const std::string& name) {
  const TemporaryFolder folder;
  write(folder / name, contents);
  try {
    read_gltf(folder / name);
  } catch (const Error& e) {
    const std::string message = e.what(), prefix = folder / "";
    return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
  }
  return "no error";
}

}  // namespace penumbra::test
