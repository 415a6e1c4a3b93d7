#include "base/progress.h"

namespace penumbra {

void Progress::start(std::string_view /*phase*/, std::uint64_t /*total*/) {}
void Progress::advance(std::uint64_t /*steps*/) {}
void Progress::finish() {}

}  // namespace penumbra
