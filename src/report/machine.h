// Where and by what a measurement was made.
#pragma once

#include <cstdint>
#include <string>

namespace penumbra::report {

struct Machine {
  std::string processor;  ///< empty if the system does not tell
  int threads = 0;        ///< in use
  std::uint64_t memory_bytes = 0;
  std::string system;
};
Machine this_machine();

struct Versions {
  std::string penumbra, compiler, embree;
};
Versions versions();

}  // namespace penumbra::report
