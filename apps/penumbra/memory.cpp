#include "memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "base/error.h"

namespace penumbra::app {
namespace {

constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t available_on_machine() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  for (std::uint64_t kilobytes; file >> name >> kilobytes; file.ignore(64, '\n'))
    if (name == "MemAvailable:") return kilobytes * 1024;
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

// A control group's own limit; "max" or no such file is none.
std::uint64_t available_in_group() {
  std::uint64_t limit = 0, used = 0;
  if (!(std::ifstream("/sys/fs/cgroup/memory.max") >> limit)) return kUnlimited;
  std::ifstream("/sys/fs/cgroup/memory.current") >> used;
  return limit > used ? limit - used : 0;
}

std::uint64_t address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
  return limit.rlim_cur;
}

std::string readable(double bytes) {
  constexpr const char* units[] = {"MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (bytes /= 1e6; bytes >= 1000 && unit + 1 < std::size(units); ++unit) bytes /= 1000;
  return fmt::format("{:.1f} {}", bytes, units[unit]);
}

}  // namespace

std::uint64_t available_memory() {
  return std::min({available_on_machine(), available_in_group(), address_space()});
}

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

double picture_bytes(const Arguments& arguments, std::size_t light_count) {
  const RenderOptions& options = arguments.render;
  const double floats = 3.0 + (options.want_visibility ? static_cast<double>(light_count) : 0) +
                        (options.want_depth ? 1 : 0) + (options.want_normal ? 3 : 0) +
                        (options.want_error ? 1 : 0) + (options.want_steps ? 1 : 0);
  return floats * sizeof(float) * options.width * options.height;
}

void check_picture_fits(const Arguments& arguments, std::size_t light_count) {
  const double needed = picture_bytes(arguments, light_count);
  const auto available = static_cast<double>(available_memory());
  if (needed <= available) return;
  throw InputError(fmt::format("--size: a picture of {}x{} needs {} of memory and {} are available",
                               arguments.render.width, arguments.render.height, readable(needed),
                               readable(available)),
                   "choose a smaller size");
}

}  // namespace penumbra::app
