// Runs the program as a user would, and catches what it says.
#pragma once

#include <sys/types.h>

#include <functional>
#include <string>
#include <vector>

namespace penumbra::test {

struct Outcome {
  int status = -1;  ///< exit status; 128 + signal if one ended it
  std::string out, err;
};

/// A child process with its outputs caught in files.
class Running {
 public:
  /// `prepare` is called in the child before it becomes the program.
  Running(const std::string& program, const std::vector<std::string>& arguments,
          const std::function<void()>& prepare = {});
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  pid_t id() const { return id_; }
  /// What it has said on stderr so far.
  std::string said() const;
  /// Waits until it has ended.
  Outcome outcome();

 private:
  pid_t id_;
  int out_, err_;
};

/// Runs `penumbra` to its end.
Outcome penumbra(const std::vector<std::string>& arguments,
                 const std::function<void()>& prepare = {});

}  // namespace penumbra::test
