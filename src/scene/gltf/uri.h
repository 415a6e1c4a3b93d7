// What a glTF uri refers to: data within itself, or a file beside the document.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace penumbra::gltf {

/// The bytes of a data: URI (RFC 2397), base64 or percent-encoded; no value if it is malformed.
std::optional<std::string> decode_data_uri(std::string_view uri);

/// True for "data:…", in any case of letters.
bool is_data_uri(std::string_view uri);

/// "%20" becomes a space and so on; a % without two hexadecimal digits stays.
std::string percent_decode(std::string_view text);

/// The path of the file that `uri` names, relative to the folder of `document`; no value for a URI
/// with a scheme, such as "https:".
std::optional<std::string> local_path(const std::string& document, std::string_view uri);

}  // namespace penumbra::gltf
