// Option values from text. Each throws InputError naming the option and what it takes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::app {

/// A finite number in [least, most].
float parse_number(std::string_view option, const std::string& text, double least, double most);

/// A whole number in [least, most].
std::int64_t parse_integer(std::string_view option, const std::string& text, std::int64_t least,
                           std::int64_t most);

/// The index of `text` among `names`; the error tells the nearest one.
std::size_t parse_choice(std::string_view option, const std::string& text,
                         std::span<const std::string_view> names);

/// The whole text as a finite number; false if it is none. Blanks around it are allowed.
bool read_number(std::string_view text, double& value);

std::vector<std::string> split(const std::string& text, char separator);

/// "a, b or c".
std::string listed(std::span<const std::string_view> names);

}  // namespace penumbra::app
