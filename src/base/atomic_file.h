// Output files that are either complete or not there: written beside, then renamed.
#pragma once

#include <string>

namespace penumbra {

/// Write to temporary_path(), then commit(). Without commit nothing of it is left, so that a
/// failure leaves an earlier file of that name untouched. What is written has no name until then,
/// so that a process that is killed leaves nothing either; where the file system knows no such
/// files (O_TMPFILE) it is PATH.partNUMBER, which a killed process leaves.
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
  void name_it();

  std::string path_, temporary_;
  std::string part_;  ///< its name while it has one that is not path_; else empty
  int file_ = -1;     ///< without a name
};

/// Removes what every AtomicFile of the process has written so far and not committed. For use right
/// before an abrupt end of the process; thread-safe.
void remove_unfinished_files();

/// Writes the whole text or bytes to `path` atomically; throws WorkError.
void write_file(const std::string& path, const std::string& contents);

/// Reads a whole file; throws InputError (missing, a folder, unreadable).
std::string read_file(const std::string& path);

}  // namespace penumbra
