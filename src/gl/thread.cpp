#include "gl/thread.h"

#include <optional>
#include <utility>

namespace penumbra::gl {

Thread::Thread(Profile profile) : thread_([this, profile] { live(profile); }) {
  std::unique_lock lock(access_);
  changed_.wait(lock, [this] { return !busy_; });
  if (!error_) return;
  lock.unlock();
  thread_.join();
  std::rethrow_exception(error_);
}

Thread::~Thread() {
  {
    const std::lock_guard lock(access_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void Thread::run(const std::function<void()>& work) {
  const std::lock_guard mine(turn_);
  std::unique_lock lock(access_);
  work_ = &work, busy_ = true, error_ = nullptr;
  changed_.notify_all();
  changed_.wait(lock, [this] { return !busy_; });
  if (error_) std::rethrow_exception(error_);
}

void Thread::live(Profile profile) {
  std::unique_lock lock(access_);
  std::optional<Context> context;
  try {
    context.emplace(profile);
    renderer_ = context->renderer();
  } catch (...) {
    error_ = std::current_exception(), ends_ = true;
  }
  busy_ = false;
  changed_.notify_all();
  for (;;) {
    changed_.wait(lock, [this] { return work_ || ends_; });
    if (!work_) return;
    const std::function<void()>* work = std::exchange(work_, nullptr);
    lock.unlock();
    std::exception_ptr error;
    try {
      (*work)();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    error_ = error, busy_ = false;
    changed_.notify_all();
  }
}

}  // namespace penumbra::gl
