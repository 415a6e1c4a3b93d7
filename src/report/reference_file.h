// A reference between two calls of the program.
#pragma once

#include <optional>
#include <string>

#include "report/reference.h"

namespace penumbra::report {

/// A number for everything that the reference depends on.
std::uint64_t reference_key(const Scene& scene, const ReferenceOptions& options,
                            const RenderOptions& picture);

enum class FileState : std::uint8_t {
  absent,
  stale,    ///< of another scene, size, camera … or version of this program
  damaged,  ///< its checksum is not that of its contents
  usable,   ///< begun or complete
};

/// Reads what save_reference() wrote under that key into `reference`, which is of the right size
/// and is left alone unless the file is usable. Throws InputError if the file cannot be read.
FileState load_reference(const std::string& file, std::uint64_t key, Reference& reference);

/// Writes it, done or not, atomically; throws WorkError.
void save_reference(const std::string& file, std::uint64_t key, const Reference& reference);

}  // namespace penumbra::report
