#include "report/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <fstream>

#include "base/parallel.h"
#include "geometry/embree_shim.h"

namespace penumbra::report {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t colon = line.find(": ");
    if (colon != line.npos) return line.substr(colon + 2);
  }
  return {};
}

}  // namespace

Machine this_machine() {
  Machine m;
  m.processor = processor_name();
  m.threads = thread_count();
  m.memory_bytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                   static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  utsname name{};
  if (uname(&name) == 0)
    m.system = std::string(name.sysname) + ' ' + name.release + ' ' + name.machine;
  return m;
}

Versions versions() {
#ifdef __clang__
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return {PENUMBRA_VERSION, compiler, RTC_VERSION_STRING};
}

}  // namespace penumbra::report
