// Work that may never come back.
#pragma once

#include <functional>
#include <string>

#include "base/progress.h"

namespace penumbra::gl {

/// How long to wait for a sign of life (progress), seconds.
struct Patience {
  double first = 600;  ///< before the phase "render" or "probe" begins: drivers may compile long
  double later = 60;   ///< between two signs afterwards
};

/// Runs `work` in a child process and gives back the bytes that it returns. A shader whose loop
/// never ends cannot be called off: its process can. The child's progress is told to `progress`.
/// InputError and WorkError of the work are thrown here again; WorkError if nothing was heard of it
/// for too long, or if it died; Cancelled when asked to stop.
///
/// The child has one thread, the caller's: work must not use parallel_for. The process must not
/// have made a Context before.
std::string guarded(const std::function<std::string(Progress&)>& work, Progress& progress,
                    const Patience& patience = {});

}  // namespace penumbra::gl
