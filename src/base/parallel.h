// Threads: work is cut into numbered pieces, and what a piece computes depends on its number alone,
// never on the thread, so that results are the same at any thread count.
#pragma once

#include <cstddef>
#include <functional>

namespace penumbra {

/// Limits the number of worker threads for as long as it lives; 0 = all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// The number of threads in use now.
int thread_count();

/// Calls body(i) for i in [0, count), in parallel; looks at cancel_requested before each.
/// An exception from body, or Cancelled, is rethrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace penumbra
