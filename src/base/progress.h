// Progress of long work, told to whoever wants to hear.
#pragma once

#include <cstdint>
#include <string_view>

namespace penumbra {

/// Receives progress; the default ignores it. advance() may be called from any thread.
class Progress {
 public:
  virtual ~Progress() = default;
  /// A phase of `total` equal steps begins. Phases follow one another, never nest.
  virtual void start(std::string_view phase, std::uint64_t total);
  virtual void advance(std::uint64_t steps);
  virtual void finish();
};

}  // namespace penumbra
