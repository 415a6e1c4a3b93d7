// zlib streams (RFC 1950).
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra::report {

/// `level`: 1 fast to 9 small.
std::string deflated(std::string_view bytes, int level);

/// None if this is no stream of `size` bytes.
std::optional<std::string> inflated(std::string_view stream, std::size_t size);

}  // namespace penumbra::report
