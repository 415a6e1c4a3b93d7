#include "values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/nearest_name.h"

namespace penumbra::app {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

template <class T>
bool read_whole(std::string_view text, T& value) {
  text = trimmed(text);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end;
}

}  // namespace

bool read_number(std::string_view text, double& value) {
  return read_whole(text, value) && std::isfinite(value);
}

float parse_number(std::string_view option, const std::string& text, double least, double most) {
  double value = 0;
  const std::string range = fmt::format("give a number from {:g} to {:g}", least, most);
  if (!read_number(text, value))
    throw InputError(fmt::format("{}: '{}' is not a number", option, text), range);
  if (value < least || value > most)
    throw InputError(fmt::format("{}: {} is out of range", option, text), range);
  return static_cast<float>(value);
}

std::int64_t parse_integer(std::string_view option, const std::string& text, std::int64_t least,
                           std::int64_t most) {
  std::int64_t value = 0;
  const std::string range = fmt::format("give a whole number from {} to {}", least, most);
  if (!read_whole(text, value))
    throw InputError(fmt::format("{}: '{}' is not a whole number", option, text), range);
  if (value < least || value > most)
    throw InputError(fmt::format("{}: {} is out of range", option, text), range);
  return value;
}

std::size_t parse_choice(std::string_view option, const std::string& text,
                         std::span<const std::string_view> names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == text) return i;
  throw InputError(
      fmt::format("{}: '{}' is unknown", option, text),
      fmt::format("did you mean {}? There are {}", nearest_name(text, names), listed(names)));
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find(separator, begin)) != text.npos; begin = end + 1)
    parts.push_back(text.substr(begin, end - begin));
  parts.push_back(text.substr(begin));
  return parts;
}

std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace penumbra::app
