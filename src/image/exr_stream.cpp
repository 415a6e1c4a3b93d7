#include "image/exr_stream.h"

#include <Iex.h>

#include <cstring>

namespace penumbra {

void ExrOutput::write(const char* bytes, int count) {
  const auto size = static_cast<std::size_t>(count);
  if (std::fwrite(bytes, 1, size, file_) == size) return;
  failed_ = true;
  Iex::throwErrnoExc();
}

std::uint64_t ExrOutput::tellp() { return static_cast<std::uint64_t>(std::ftell(file_)); }

void ExrOutput::seekp(std::uint64_t position) {
  if (std::fseek(file_, static_cast<long>(position), SEEK_SET) == 0) return;
  failed_ = true;
  Iex::throwErrnoExc();
}

bool ExrOutput::flush() { return std::fflush(file_) == 0 && !failed_; }

bool ExrInput::read(char* out, int count) {
  const auto size = static_cast<std::uint64_t>(count);
  if (position_ > bytes_.size() || size > bytes_.size() - position_)
    throw Iex::InputExc("the file ends early");
  std::memcpy(out, bytes_.data() + position_, size);
  position_ += size;
  return position_ < bytes_.size();
}

}  // namespace penumbra
