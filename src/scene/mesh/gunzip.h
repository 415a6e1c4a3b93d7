// Files compressed with gzip.
#pragma once

#include <string>
#include <string_view>

namespace penumbra {

/// Decompresses gzip data (all members); `file` is for errors. Throws InputError with the byte if
/// it is damaged or ends early, or expands to more than 64 MB and more than 200 times its size, so
/// that a small file cannot take all memory.
std::string gunzip(const std::string& file, std::string_view compressed);

}  // namespace penumbra
