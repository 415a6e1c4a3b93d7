// STL (3D Systems 1988, StereoLithography Interface Specification): loose triangles, welded here.
// Facet normals are ignored: they repeat the winding, or contradict it.
#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "base/atomic_file.h"
#include "base/error.h"
#include "scene/load.h"
#include "scene/mesh/single_mesh.h"
#include "scene/mesh/text_cursor.h"
#include "scene/mesh/weld.h"

namespace penumbra {
namespace {

constexpr std::size_t kHeaderBytes = 84, kFacetBytes = 50, kNormalBytes = 12;

std::uint32_t declared_facets(std::string_view contents) {
  std::uint32_t count;
  std::memcpy(&count, contents.data() + kHeaderBytes - sizeof count, sizeof count);
  return count;
}

bool has_binary_size(std::string_view contents) {
  return contents.size() >= kHeaderBytes &&
         contents.size() == kHeaderBytes + kFacetBytes * declared_facets(contents);
}

/// Many binary files begin with "solid" too: text has no zero bytes.
bool is_text(std::string_view contents) {
  const auto begin = contents.substr(0, 512);
  const auto first = begin.find_first_not_of(" \t\r\n");
  return !has_binary_size(contents) && first != std::string_view::npos &&
         begin.substr(first).starts_with("solid") && begin.find('\0') == std::string_view::npos;
}

/// A mesh of loose triangles, three corners each.
Mesh weld_triangles(const std::string& file, const std::vector<Vec3>& corners) {
  if (corners.size() >= std::size_t{1} << 31)
    throw InputError({file}, "has more triangles than one mesh can hold",
                     "split the model into several files");
  Weld weld = weld_positions(corners);
  Mesh mesh;
  mesh.positions.reserve(weld.first.size());
  for (const std::uint32_t first : weld.first) mesh.positions.push_back(corners[first]);
  mesh.indices = std::move(weld.id);
  return mesh;
}

std::vector<Vec3> read_binary(const std::string& file, std::string_view contents) {
  if (contents.size() < kHeaderBytes)
    throw InputError({file, contents.size()},
                     "this is no STL file: it neither begins with 'solid' nor has 84 bytes",
                     "check whether the file is complete");
  const std::size_t count = declared_facets(contents);
  if (count > (contents.size() - kHeaderBytes) / kFacetBytes)
    throw InputError({file, contents.size()},
                     fmt::format("the file ends before the {} triangles that it declares", count),
                     "check whether the file is complete");
  std::vector<Vec3> corners(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    std::memcpy(&corners[3 * i], contents.data() + kHeaderBytes + kFacetBytes * i + kNormalBytes,
                3 * sizeof(Vec3));
  return corners;
}

/// Reads the text form, solid by solid.
class TextReader {
 public:
  TextReader(const std::string& file, std::string_view contents) : cursor_(file, contents) {}

  bool next_solid() {
    cursor_.skip_white_space();
    if (cursor_.at_end()) return false;
    expect("solid");
    name = cursor_.rest_of_line();
    corners.clear();
    while (!next_is("endsolid")) read_facet();
    expect("endsolid");
    cursor_.next_line();
    return true;
  }

  std::string name;
  std::vector<Vec3> corners;

 private:
  bool next_is(const char* keyword) {
    cursor_.skip_white_space();
    TextCursor ahead = cursor_;
    return matches(ahead.word(), keyword);
  }

  static bool matches(std::string_view word, std::string_view keyword) {
    const auto same = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; };
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(), same);
  }

  void expect(const char* keyword) {
    cursor_.skip_white_space();
    const std::size_t begin = cursor_.offset();
    const std::string_view word = cursor_.word();
    if (matches(word, keyword)) return;
    const std::string instead = word.empty() ? "the file ends" : in_quotes(word) + " stands there";
    cursor_.fail_at(begin, fmt::format("'{}' is missing: {}", keyword, instead),
                    "check whether the file is complete");
  }

  void read_facet() {
    expect("facet");
    cursor_.next_line();
    expect("outer"), expect("loop");
    for (int i = 0; i < 3; ++i) {
      expect("vertex");
      const float x = cursor_.number("x"), y = cursor_.number("y");
      corners.emplace_back(x, y, cursor_.number("z"));
    }
    expect("endloop"), expect("endfacet");
  }

  TextCursor cursor_;
};

}  // namespace

Scene read_stl(const std::string& path) {
  const std::string contents = read_file(path);
  Scene scene;
  scene.materials.emplace_back().name = "default";
  if (is_text(contents)) {
    scene.report.format = "STL (ascii)";
    for (TextReader reader(path, contents); reader.next_solid();)
      add_object(scene, reader.name.empty() ? stem_of(path) : reader.name,
                 weld_triangles(path, reader.corners), 0);
  } else {
    scene.report.format = "STL (binary)";
    add_object(scene, stem_of(path), weld_triangles(path, read_binary(path, contents)), 0);
  }
  return scene;
}

}  // namespace penumbra
