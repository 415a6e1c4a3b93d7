#include "report/deflate.h"

#include <zlib.h>

namespace penumbra::report {

std::string deflated(std::string_view bytes, int level) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  compress2(reinterpret_cast<Bytef*>(out.data()), &size,
            reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), level);
  out.resize(size);
  return out;
}

std::optional<std::string> inflated(std::string_view stream, std::size_t size) {
  std::string out(size, '\0');
  uLongf found = size;
  const int status = uncompress(reinterpret_cast<Bytef*>(out.data()), &found,
                                reinterpret_cast<const Bytef*>(stream.data()), stream.size());
  if (status != Z_OK || found != size) return std::nullopt;
  return out;
}

}  // namespace penumbra::report
