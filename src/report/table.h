// The comparison as a table for a terminal.
#pragma once

#include <string>

#include "report/comparison.h"

namespace penumbra::report {

/// Lines of at most 100 columns (reasons aside): the reference, a row a method, sweeps, the advice.
std::string table_text(const Comparison& comparison);

}  // namespace penumbra::report
