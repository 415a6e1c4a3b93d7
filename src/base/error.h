// Errors that a person can act on: what is wrong, where, and what to do.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>

namespace penumbra {

/// Where in a file: FILE:LINE:COLUMN for text, FILE:BYTE for binary, FILE alone otherwise.
struct Place {
  std::string file;
  std::optional<std::uint64_t> line_or_byte{};
  std::optional<std::uint64_t> column{};
};

/// "FILE:LINE:COLUMN: " or as much of it as is known; empty if there is no file.
std::string to_string(const Place& place);

/// The line of an error that was made elsewhere (another process).
struct Told {
  std::string line;
};

/// Common base; what() is one line without newlines: "PLACE: what is wrong; what to do".
class Error : public std::runtime_error {
 public:
  Error(const Place& place, const std::string& what, const std::string& remedy);
  Error(const std::string& what, const std::string& remedy) : Error(Place{}, what, remedy) {}
  explicit Error(const Told& told) : std::runtime_error(told.line) {}
};

/// The call or its input is wrong: exit status 2.
class InputError : public Error {
  using Error::Error;
};

/// The call was right and the work failed (disk full, output not writable): exit status 1.
class WorkError : public Error {
  using Error::Error;
};

/// The user asked to stop (Ctrl-C).
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped") {}
};

}  // namespace penumbra
