#include "report/process_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace penumbra::report {
namespace {

/// A line of /proc/self/status such as "VmHWM:  1234 kB", in bytes.
std::optional<std::uint64_t> status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(name + ":")) return std::stoull(line.substr(name.size() + 1)) * 1024;
  return std::nullopt;
}

/// Sets the peak back to what is held now (proc(5), clear_refs).
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  malloc_trim(0);
  if (reset_peak()) before_ = status("VmRSS");
}

std::optional<std::uint64_t> PeakMemory::bytes() const {
  const auto peak = status("VmHWM");
  if (!before_ || !peak) return std::nullopt;
  return *peak > *before_ ? *peak - *before_ : 0;
}

}  // namespace penumbra::report
