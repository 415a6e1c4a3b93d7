#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "base/cancel.h"
#include "base/error.h"

namespace penumbra {
namespace {

TEST(ParallelFor, VisitsEveryPieceOnce) {
  for (const int threads : {1, 2, 5}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(thread_count(), threads);
    std::vector<int> visits(1000, 0);
    parallel_for(visits.size(), [&](std::size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(1000, 1));
  }
  parallel_for(0, [](std::size_t) { FAIL(); });
}

TEST(ParallelFor, PassesExceptionsOn) {
  EXPECT_THROW(parallel_for(100,
                            [](std::size_t i) {
                              if (i == 57) throw std::runtime_error("57");
                            }),
               std::runtime_error);
}

TEST(ParallelFor, StopsWhenAsked) {
  std::atomic<int> done{0};
  EXPECT_THROW(parallel_for(100000,
                            [&](std::size_t) {
                              if (++done == 10) cancel_requested = true;
                            }),
               Cancelled);
  cancel_requested = false;
  EXPECT_LT(done, 1000);
}

}  // namespace
}  // namespace penumbra
