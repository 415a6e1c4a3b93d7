// Memory: what there is, what a picture needs.
#pragma once

#include <cstddef>
#include <cstdint>

#include "arguments.h"

namespace penumbra::app {

/// Bytes that this process may still take, by the machine, its control group and its limits.
std::uint64_t available_memory();

/// The most bytes this process has held so far.
std::uint64_t peak_memory();

/// Bytes of the pixel buffers of a render with that many lights.
double picture_bytes(const Arguments& arguments, std::size_t light_count);

/// Throws InputError, telling both amounts, if the picture does not fit into memory.
void check_picture_fits(const Arguments& arguments, std::size_t light_count);

}  // namespace penumbra::app
