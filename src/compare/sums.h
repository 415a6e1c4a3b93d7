// Sums over many values: by blocks of fixed size, added up in order, so that they have the same
// bits at any thread count.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/parallel.h"

namespace penumbra {

/// The sum of body(first, last) over blocks of [0, count), from Sum{} by +=.
template <class Sum, class Body>
Sum sum_blocks(std::size_t count, const Body& body) {
  constexpr std::size_t size = std::size_t{1} << 14;
  std::vector<Sum> sums((count + size - 1) / size);
  parallel_for(sums.size(),
               [&](std::size_t i) { sums[i] = body(i * size, std::min(count, (i + 1) * size)); });
  Sum total{};
  for (const Sum& sum : sums) total += sum;
  return total;
}

}  // namespace penumbra
