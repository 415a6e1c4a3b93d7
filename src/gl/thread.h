// A context that many threads may ask.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

#include "gl/context.h"

namespace penumbra::gl {

/// A thread with a Context of its own, which does one piece of work after the other. What it makes
/// under the context must be deleted by its work too.
class Thread {
 public:
  /// Throws what Context throws.
  explicit Thread(Profile profile);
  ~Thread();
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;

  /// The driver's name for what draws.
  const std::string& renderer() const { return renderer_; }

  /// Waits until the work is done; throws what it throws. From any thread but its own.
  void run(const std::function<void()>& work);

 private:
  void live(Profile profile);

  std::mutex turn_;    ///< of those who ask
  std::mutex access_;  ///< to what follows
  std::condition_variable changed_;
  const std::function<void()>* work_ = nullptr;
  bool busy_ = true, ends_ = false;
  std::exception_ptr error_;
  std::string renderer_;
  std::thread thread_;
};

}  // namespace penumbra::gl
