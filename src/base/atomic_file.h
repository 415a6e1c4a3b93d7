// Output files that are either complete or not there: written beside, then renamed.
#pragma once

#include <string>

namespace penumbra {

/// Write to temporary_path(), then commit(). Without commit the destructor removes the file, so
/// that a failure leaves an earlier file of that name untouched.
class AtomicFile {
 public:
  /// Checks that the folder exists and can be written to and that no device or folder has the name;
  /// throws WorkError otherwise.
  explicit AtomicFile(std::string path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::string& temporary_path() const { return temporary_; }
  /// Flushes to disk and renames into place; throws WorkError.
  void commit();

 private:
  std::string path_, temporary_;
  bool committed_ = false;
};

/// Removes what every AtomicFile of the process has written so far and not committed. For use right
/// before an abrupt end of the process; thread-safe.
void remove_unfinished_files();

/// Writes the whole text or bytes to `path` atomically; throws WorkError.
void write_file(const std::string& path, const std::string& contents);

/// Reads a whole file; throws InputError (missing, a folder, unreadable).
std::string read_file(const std::string& path);

}  // namespace penumbra
