#include "scene/gltf/source.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/atomic_file.h"

namespace penumbra::gltf {
namespace {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;
constexpr const char* kGetAgain = "copy or export the file again";

}  // namespace

Source::Source(const std::string& path) : file_(path), bytes_(read_file(path)) {
  binary_ = bytes_.starts_with("glTF");
  binary_ ? cut_binary() : cut_text();
}

void Source::fail(std::size_t at, const std::string& what, const std::string& remedy) const {
  throw InputError({file_, at}, what, remedy);
}

std::uint32_t Source::word(std::size_t at) const {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_[at + i]));
  };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

void Source::cut_text() {
  const std::size_t begin = bytes_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
  const std::size_t first = bytes_.find_first_not_of(" \t\r\n", begin);
  const bool looks_like_json = first != std::string::npos && bytes_[first] == '{';
  if (!looks_like_json && file_.ends_with(".glb"))
    fail(0, "this is no binary glTF file: it does not begin with 'glTF'", kGetAgain);
  json_ = {begin, bytes_.size() - begin};
}

std::size_t Source::checked_length() const {
  if (bytes_.size() < 12)
    fail(bytes_.size(), "the file ends within the header of a binary glTF file", kGetAgain);
  if (word(4) != 2)
    fail(4, fmt::format("this is version {} of binary glTF, not 2", word(4)),
         "export it as glTF 2.0");
  const std::size_t length = word(8);
  if (length > bytes_.size())
    fail(bytes_.size(), fmt::format("the file ends after {} of {} bytes", bytes_.size(), length),
         kGetAgain);
  return length;
}

void Source::take_chunk(std::size_t at, std::size_t length) {
  const std::uint32_t type = word(at + 4);
  if (at == 12 && type != kJsonChunk) fail(at, "the first chunk is not JSON", kGetAgain);
  if (at == 12) json_ = {at + 8, length};
  if (type == kBinChunk && bin_.length == 0) bin_ = {at + 8, length};
}

void Source::cut_binary() {
  const std::size_t end = checked_length();
  if (end < 20) fail(end, "the file has no JSON chunk", kGetAgain);
  for (std::size_t at = 12; at < end;) {
    const std::size_t left = end - at;
    if (left < 8) fail(at, "the file ends within the header of a chunk", kGetAgain);
    const std::size_t length = word(at);
    if (length > left - 8)
      fail(
          at,
          fmt::format("a chunk of {} bytes does not fit into the {} that follow", length, left - 8),
          kGetAgain);
    take_chunk(at, length);
    at += 8 + length;
  }
  // Some writers pad with zeros where the standard asks for spaces.
  while (json_.length > 0 && bytes_[json_.begin + json_.length - 1] == '\0') --json_.length;
}

Place Source::place(std::size_t offset_in_json) const {
  const std::string_view before = json().substr(0, std::min(offset_in_json, json_.length));
  if (binary_) return {file_, json_.begin + before.size()};
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 = 0
  return {file_, static_cast<std::uint64_t>(line), before.size() - line_begin + 1};
}

}  // namespace penumbra::gltf
