// The file: a mark, the key, the contents' size and digest, then the contents, in the byte order of
// the machine (another order gives another mark).
#include "report/reference_file.h"

#include <cstring>
#include <filesystem>

#include "base/atomic_file.h"
#include "report/digest.h"

namespace penumbra::report {
namespace {

/// To be changed whenever the same key may mean other numbers.
constexpr std::uint64_t mark = 0x31666572706e6570u;

struct Header {
  std::uint64_t mark = 0, key = 0, size = 0, digest = 0;
};

template <class T>
void append(std::string& text, const std::vector<T>& values) {
  text.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

void append(std::string& text, const auto& value) {
  text.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string contents_of(const Reference& r) {
  std::string text;
  append(text, r.seconds), append(text, r.rays), append(text, r.exposure_ev);
  append(text, r.surface), append(text, r.at), append(text, r.tiles), append(text, r.color.data);
  return text;
}

/// Takes values from the front of a text of the right length.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  template <class T>
  void take(std::vector<T>& values) {
    take(values.data(), values.size() * sizeof(T));
  }
  void take(auto& value) { take(&value, sizeof value); }
  std::size_t left() const { return text_.size(); }

 private:
  void take(void* to, std::size_t size) {
    std::memcpy(to, text_.data(), size);
    text_.remove_prefix(size);
  }
  std::string_view text_;
};

std::uint64_t digest_of(std::string_view text) {
  Digest d;
  d.add(text);
  return d.value();
}

/// False if the contents are of another length than such a reference has.
bool read_contents(std::string_view text, Reference& r) {
  const std::size_t fields = sizeof r.seconds + sizeof r.rays + sizeof r.exposure_ev +
                             r.surface.size() + r.at.size() * sizeof(PointReference) +
                             r.tiles.size();
  const std::size_t colors = 3 * r.pixels() * sizeof(float);
  if (text.size() != fields && text.size() != fields + colors) return false;
  Reader reader(text);
  reader.take(r.seconds), reader.take(r.rays), reader.take(r.exposure_ev);
  reader.take(r.surface), reader.take(r.at), reader.take(r.tiles);
  if (reader.left() == 0) return true;
  r.color = Image(r.width, r.height, 3);
  reader.take(r.color.data);
  return true;
}

}  // namespace

std::uint64_t reference_key(const Scene& scene, const ReferenceOptions& options,
                            const RenderOptions& picture) {
  Digest d;
  d.add(report::digest_of(scene));
  d.add(options.width), d.add(options.height), d.add(options.camera);
  d.add(options.target), d.add(options.seed);
  d.add(picture.spp), d.add(picture.mirror_depth);
  return d.value();
}

FileState load_reference(const std::string& file, std::uint64_t key, Reference& reference) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return FileState::absent;
  const std::string text = read_file(file);
  Header header;
  if (text.size() < sizeof header) return FileState::damaged;
  std::memcpy(&header, text.data(), sizeof header);
  const std::string_view contents = std::string_view(text).substr(sizeof header);
  if (header.mark != mark) return FileState::damaged;
  if (header.size != contents.size() || header.digest != digest_of(contents))
    return FileState::damaged;
  if (header.key != key) return FileState::stale;
  Reference read = reference;
  if (!read_contents(contents, read)) return FileState::damaged;
  reference = std::move(read);
  return FileState::usable;
}

void save_reference(const std::string& file, std::uint64_t key, const Reference& reference) {
  const std::string contents = contents_of(reference);
  const Header header{mark, key, contents.size(), digest_of(contents)};
  std::string text;
  text.reserve(sizeof header + contents.size());
  append(text, header);
  text += contents;
  write_file(file, text);
}

}  // namespace penumbra::report
