#include "scene/mesh/gunzip.h"

#include <fmt/core.h>
#define ZLIB_CONST  // next_in points to const
#include <zlib.h>

#include <algorithm>
#include <climits>

#include "base/cancel.h"
#include "base/error.h"

namespace penumbra {
namespace {

/// zlib's stream over the input; its counters are 32 bits wide, ours are not.
class Inflater {
 public:
  Inflater(const std::string& file, std::string_view input) : file_(file), input_(input) {
    constexpr int gzip_with_largest_window = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_with_largest_window) != Z_OK)
      throw WorkError({file_}, "cannot be decompressed (out of memory)", "free some memory");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  /// Fills the buffer as far as there is data, in runs of at most INT_MAX bytes; returns how much
  /// it gave. Less than `size` is the end.
  std::size_t read(char* buffer, std::size_t size) {
    std::size_t given = 0;
    while (given < size && !done_) {
      stream_.next_out = reinterpret_cast<Bytef*>(buffer + given);
      stream_.avail_out = static_cast<uInt>(std::min<std::size_t>(size - given, INT_MAX));
      const uInt wanted = stream_.avail_out;
      while (stream_.avail_out > 0 && !done_) step();
      given += wanted - stream_.avail_out;
    }
    return given;
  }

 private:
  void step() {
    const std::size_t left = input_.size() - at_;
    stream_.next_in = reinterpret_cast<const Bytef*>(input_.data() + at_);
    stream_.avail_in = static_cast<uInt>(std::min<std::size_t>(left, INT_MAX));
    const uInt given = stream_.avail_in;
    const int status = inflate(&stream_, Z_NO_FLUSH);
    at_ += given - stream_.avail_in;
    if (status == Z_STREAM_END) return next_member();
    if (status == Z_BUF_ERROR || (status == Z_OK && given == 0))
      fail("the gzip data ends early", "check whether the file is complete");
    if (status != Z_OK)
      fail(fmt::format("the gzip data is damaged ({})", stream_.msg ? stream_.msg : "zlib"),
           "check whether the file is complete");
  }

  /// Members may follow one another; anything else after one is padding.
  void next_member() {
    done_ = input_.substr(at_, 2) != "\x1f\x8b";
    inflateReset(&stream_);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const {
    throw InputError({file_, at_}, what, remedy);
  }

  const std::string& file_;
  std::string_view input_;
  std::size_t at_ = 0;
  bool done_ = false;
  z_stream stream_{};
};

}  // namespace

std::string gunzip(const std::string& file, std::string_view compressed) {
  const std::size_t limit = std::max<std::size_t>(std::size_t{64} << 20, 200 * compressed.size());
  Inflater inflater(file, compressed);
  std::string text;
  for (std::size_t size = 0;;) {
    throw_if_cancelled();
    text.resize(size + std::max<std::size_t>(size / 2, 4 * compressed.size() + (1 << 16)));
    const std::size_t got = inflater.read(text.data() + size, text.size() - size);
    size += got;
    if (size > limit)
      throw InputError({file}, "expands to more than 200 times its size", "decompress it first");
    if (size < text.size()) {
      text.resize(size);
      return text;
    }
  }
}

}  // namespace penumbra
