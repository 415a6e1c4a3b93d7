#include "base/cancel.h"

#include "base/error.h"

namespace penumbra {

void throw_if_cancelled() {
  if (cancel_requested.load(std::memory_order_relaxed)) throw Cancelled();
}

}  // namespace penumbra
