#include "gl/guarded.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include "base/cancel.h"
#include "base/error.h"

namespace penumbra::gl {
namespace {

using Clock = std::chrono::steady_clock;

enum class Kind : char { start, advance, finish, result, input_error, work_error, cancelled };

struct Header {
  Kind kind;
  std::uint64_t number;  // of steps, or of bytes that follow
};

// What the child says.
class Sender : public Progress {
 public:
  explicit Sender(int pipe) : pipe_(pipe) {}
  void start(std::string_view phase, std::uint64_t total) override {
    std::string text(sizeof total, '\0');
    std::memcpy(text.data(), &total, sizeof total);
    send(Kind::start, text.append(phase));
  }
  void advance(std::uint64_t steps) override { put({Kind::advance, steps}); }
  void finish() override { put({Kind::finish, 0}); }
  void send(Kind kind, const std::string& bytes) {
    put({kind, bytes.size()});
    write_all(bytes.data(), bytes.size());
  }

 private:
  void put(const Header& header) { write_all(&header, sizeof header); }
  void write_all(const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    while (size > 0) {
      const ssize_t written = ::write(pipe_, at, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) ::_exit(1);  // nobody listens any more
      at += written, size -= static_cast<std::size_t>(written);
    }
  }

  int pipe_;
};

[[noreturn]] void be_the_child(const std::function<std::string(Progress&)>& work, int pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  Sender sender(pipe);
  try {
    sender.send(Kind::result, work(sender));
  } catch (const InputError& error) {
    sender.send(Kind::input_error, error.what());
  } catch (const Cancelled&) {
    sender.send(Kind::cancelled, "");
  } catch (const std::exception& error) {
    sender.send(Kind::work_error, error.what());
  }
  ::_exit(0);
}

// The child as its parent knows it; ends it in any case.
class Child {
 public:
  Child(pid_t id, int pipe) : id_(id), pipe_(pipe) {}
  ~Child() {
    ::kill(id_, SIGKILL);
    int status = 0;
    while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    ::close(pipe_);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string listen(Progress& progress, const Patience& patience);

 private:
  void read_all(void* data, std::size_t size);
  void wait_for_more();

  pid_t id_;
  int pipe_;
  double patience_ = 0;
  Clock::time_point last_sign_ = Clock::now();
};

void Child::wait_for_more() {
  for (;;) {
    throw_if_cancelled();
    pollfd look{pipe_, POLLIN, 0};
    if (::poll(&look, 1, 50) > 0) return;
    const std::chrono::duration<double> silent = Clock::now() - last_sign_;
    if (silent.count() > patience_)
      throw WorkError("the OpenGL driver has drawn nothing for " +
                          std::to_string(static_cast<int>(patience_)) +
                          " s and was stopped: does a loop of the shader never end?",
                      "end every loop after a number of turns, or choose a smaller --size");
  }
}

void Child::read_all(void* data, std::size_t size) {
  char* at = static_cast<char*>(data);
  while (size > 0) {
    wait_for_more();
    const ssize_t got = ::read(pipe_, at, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0)
      throw WorkError("the OpenGL driver broke off", "use another driver, or a simpler scene");
    at += got, size -= static_cast<std::size_t>(got);
    last_sign_ = Clock::now();
  }
}

std::string Child::listen(Progress& progress, const Patience& patience) {
  patience_ = patience.first;
  for (;;) {
    Header header{};
    read_all(&header, sizeof header);
    if (header.kind == Kind::advance) progress.advance(header.number);
    if (header.kind == Kind::finish) progress.finish();
    if (header.kind == Kind::advance || header.kind == Kind::finish) continue;
    std::string bytes(header.number, '\0');
    read_all(bytes.data(), bytes.size());
    if (header.kind == Kind::result) return bytes;
    if (header.kind == Kind::input_error) throw InputError(Told{bytes});
    if (header.kind == Kind::work_error) throw WorkError(Told{bytes});
    if (header.kind == Kind::cancelled) throw Cancelled();
    std::uint64_t total = 0;
    std::memcpy(&total, bytes.data(), sizeof total);
    const std::string phase = bytes.substr(sizeof total);
    if (phase == "render" || phase == "probe") patience_ = patience.later;
    progress.start(phase, total);
  }
}

}  // namespace

std::string guarded(const std::function<std::string(Progress&)>& work, Progress& progress,
                    const Patience& patience) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0)
    throw WorkError("no pipe can be made (" + std::string(std::strerror(errno)) + ")",
                    "close some programs");
  const pid_t id = ::fork();
  if (id < 0)
    throw WorkError("no process can be made (" + std::string(std::strerror(errno)) + ")",
                    "close some programs");
  if (id == 0) {
    ::close(ends[0]);
    be_the_child(work, ends[1]);
  }
  ::close(ends[1]);
  return Child(id, ends[0]).listen(progress, patience);
}

}  // namespace penumbra::gl
