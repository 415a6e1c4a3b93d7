// Memory of this process, as Linux counts it.
#pragma once

#include <cstdint>
#include <optional>

namespace penumbra::report {

/// Bytes that a piece of work takes at its peak, beyond what the process held before.
class PeakMemory {
 public:
  /// Gives freed memory back and begins to watch.
  PeakMemory();
  /// None where the system does not tell.
  std::optional<std::uint64_t> bytes() const;

 private:
  std::optional<std::uint64_t> before_;
};

}  // namespace penumbra::report
