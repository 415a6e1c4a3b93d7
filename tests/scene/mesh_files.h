// Small model files for the readers' tests.
#pragma once

#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "scene/scene.h"

namespace penumbra::test {

/// A folder that is removed with all its files; in memory where there is such a place, because
/// disks take a millisecond for each of thousands of small files.
class TempFolder {
 public:
  TempFolder() {
    const bool has_shm = access("/dev/shm", W_OK) == 0;
    const std::filesystem::path base =
        has_shm ? "/dev/shm" : std::filesystem::temp_directory_path();
    path_ = (base / "penumbraXXXXXX").string();
    if (!mkdtemp(path_.data())) throw std::runtime_error("no temporary folder");
  }
  ~TempFolder() { std::filesystem::remove_all(path_); }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, std::string_view contents) const {
    std::ofstream(path(name), std::ios::binary)
        .write(contents.data(), static_cast<std::streamsize>(contents.size()));
    return path(name);
  }

 private:
  std::string path_;
};

/// The message of the InputError that `call` throws, its folder taken away; else "no error".
template <class Call>
std::string input_error(const TempFolder& folder, const Call& call) {
  try {
    call();
  } catch (const InputError& e) {
    std::string message = e.what();
    if (message.starts_with(folder.path(""))) message.erase(0, folder.path("").size());
    return message;
  }
  return "no error";
}

template <class T>
void put(std::string& bytes, T value, bool big_endian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  if (big_endian) std::reverse(raw, raw + sizeof(T));
  bytes.append(raw, sizeof(T));
}

inline std::string gzip(std::string_view text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, text.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::size_t triangles_in(const Scene& scene) {
  std::size_t count = 0;
  for (const Instance& i : scene.instances) count += scene.meshes[i.mesh].triangle_count();
  return count;
}

/// Twice the area of all triangles, as a vector.
inline Vec3d area_vector(const Mesh& mesh) {
  Vec3d sum;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.indices[i + k]]); };
    sum += cross(corner(1) - corner(0), corner(2) - corner(0));
  }
  return sum;
}

}  // namespace penumbra::test
