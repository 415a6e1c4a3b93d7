#include <fmt/core.h>

#include "base/atomic_file.h"
#include "scene/load.h"
#include "scene/mesh/gunzip.h"
#include "scene/mesh/ply_layout.h"
#include "scene/mesh/single_mesh.h"

namespace penumbra {
namespace {

std::string format_name(PlyEncoding encoding, bool compressed) {
  constexpr const char* names[] = {"ascii", "binary, little-endian", "binary, big-endian"};
  return fmt::format("Stanford PLY ({}{})", names[static_cast<int>(encoding)],
                     compressed ? ", gzip" : "");
}

}  // namespace

Scene read_ply(const std::string& path) {
  std::string contents = read_file(path);
  const bool compressed = contents.starts_with("\x1f\x8b");
  if (compressed) contents = gunzip(path, contents);
  const PlyHeader header = parse_ply_header(path, contents);
  const PlyLayout layout = layout_of(path, header);
  const auto read_body = header.encoding == PlyEncoding::ascii ? read_ply_ascii : read_ply_binary;
  Mesh mesh;
  const std::uint64_t too_small = read_body(path, contents, header, layout, mesh);

  Scene scene;
  scene.report.format = format_name(header.encoding, compressed);
  if (too_small > 0)
    scene.report.warnings.push_back(
        fmt::format("{} faces with fewer than three corners were left out", too_small));
  scene.materials.emplace_back().name = "default";
  add_object(scene, stem_of(path), std::move(mesh), 0);
  return scene;
}

}  // namespace penumbra
