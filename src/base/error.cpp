#include "base/error.h"

namespace penumbra {
namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

}  // namespace

std::string to_string(const Place& place) {
  if (place.file.empty()) return {};
  std::string text = place.file;
  if (place.line_or_byte) text += ':' + std::to_string(*place.line_or_byte);
  if (place.column) text += ':' + std::to_string(*place.column);
  return text + ": ";
}

Error::Error(const Place& place, const std::string& what, const std::string& remedy)
    : std::runtime_error(one_line(to_string(place) + what + "; " + remedy)) {}

}  // namespace penumbra
