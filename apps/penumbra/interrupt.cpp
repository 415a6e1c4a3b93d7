#include "interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "base/atomic_file.h"
#include "base/cancel.h"

namespace penumbra::app {
namespace {

sem_t interrupted;
std::atomic<bool> finishes{false};  // FinishOnInterrupt
std::atomic<int> interrupts{0};

// Only what a signal handler may do.
void on_signal(int signal) {
  cancel_requested = true;
  if (signal == SIGINT && ++interrupts == 1 && finishes) return;
  sem_post(&interrupted);
}

void end_after_grace() {
  while (sem_wait(&interrupted) != 0) {
  }
  if (!finishes) std::this_thread::sleep_for(std::chrono::milliseconds(800));
  remove_unfinished_files();
  std::fputs("penumbra: stopped\n", stderr);
  ::_exit(130);
}

}  // namespace

void stop_on_interrupt() {
  sem_init(&interrupted, 0, 0);
  std::thread(end_after_grace).detach();
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction old {};
    sigaction(signal, nullptr, &old);
    if (old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  // A file-size limit is then an error of write(2) like a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
}

FinishOnInterrupt::FinishOnInterrupt() { finishes = true; }
FinishOnInterrupt::~FinishOnInterrupt() { finishes = false; }

bool FinishOnInterrupt::take_interrupt() const {
  if (interrupts == 0) return false;
  cancel_requested = false;
  return true;
}

bool was_interrupted() { return interrupts > 0; }

}  // namespace penumbra::app
