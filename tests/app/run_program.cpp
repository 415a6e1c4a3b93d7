#include "support/run_program.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace penumbra::test {
namespace {

std::string read(int file) {
  struct stat status {};
  ::fstat(file, &status);
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t size = ::pread(file, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

std::string contents(int file) {
  const std::string text = read(file);
  ::close(file);
  return text;
}

[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::execv(argv[0], argv.data());
  ::_exit(127);
}

}  // namespace

Running::Running(const std::string& program, const std::vector<std::string>& arguments,
                 const std::function<void()>& prepare)
    : id_(0), out_(::memfd_create("out", 0)), err_(::memfd_create("err", 0)) {
  id_ = ::fork();
  if (id_ != 0) return;
  ::dup2(out_, STDOUT_FILENO);
  ::dup2(err_, STDERR_FILENO);
  if (prepare) prepare();
  become(program, arguments);
}

std::string Running::said() const { return read(err_); }

Outcome Running::outcome() {
  int status = 0;
  ::waitpid(id_, &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, contents(out_), contents(err_)};
}

Outcome penumbra(const std::vector<std::string>& arguments, const std::function<void()>& prepare) {
  return Running(PENUMBRA_PROGRAM, arguments, prepare).outcome();
}

}  // namespace penumbra::test
