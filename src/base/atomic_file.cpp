#include "base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>

#include "base/error.h"

namespace penumbra {
namespace fs = std::filesystem;
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// What has no size of its own (pipes, devices) may be endless.
constexpr std::size_t kLongestStream = std::size_t{1} << 30;

std::string reason() { return std::strerror(errno); }

std::string part_name(const std::string& path) {
  return path + ".part" + std::to_string(::getpid());
}

// Temporary files that are there now. Never destroyed: the process may end while they are in use.
struct Unfinished {
  std::mutex mutex;
  std::set<std::string> names;
};
Unfinished& unfinished() {
  static auto& all = *new Unfinished;
  return all;
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw WorkError({path_}, "the folder " + folder.string() + " does not exist",
                    "create it or choose another output");
  if (fs::is_directory(path_, ignored))
    throw WorkError({path_}, "this is a folder", "name a file for the output");
  if (fs::exists(path_, ignored) && !fs::is_regular_file(path_, ignored))
    throw WorkError({path_}, "this is not an ordinary file", "choose another output");
  const fs::path here = folder.empty() ? fs::path(".") : folder;
  const std::lock_guard lock(unfinished().mutex);
  file_ = ::open(here.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
  if (file_ >= 0) {
    temporary_ = "/proc/self/fd/" + std::to_string(file_);
    if (::access(temporary_.c_str(), W_OK) == 0) return;
    ::close(file_), file_ = -1;
  }
  part_ = temporary_ = part_name(path_);
  const int fd = ::open(part_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0)
    throw WorkError({path_}, "cannot be written (" + reason() + ")", "choose another output");
  ::close(fd);
  unfinished().names.insert(part_);
}

AtomicFile::~AtomicFile() {
  const std::lock_guard lock(unfinished().mutex);
  if (file_ >= 0) ::close(file_);
  if (part_.empty()) return;
  unfinished().names.erase(part_);
  ::unlink(part_.c_str());
}

// A name cannot be taken over from another file at once: for a moment it has one of its own.
void AtomicFile::name_it() {
  const std::string part = part_name(path_);
  ::unlink(part.c_str());
  const std::lock_guard lock(unfinished().mutex);
  if (::linkat(AT_FDCWD, temporary_.c_str(), AT_FDCWD, part.c_str(), AT_SYMLINK_FOLLOW) != 0)
    throw WorkError({path_}, "cannot be written (" + reason() + ")", "choose another output");
  part_ = part;
  unfinished().names.insert(part_);
}

void AtomicFile::commit() {
  const int fd = file_ >= 0 ? ::dup(file_) : ::open(part_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = fd >= 0 && ::fsync(fd) == 0;
  if (fd >= 0) ::close(fd);
  if (flushed && part_.empty()) name_it();
  const std::lock_guard lock(unfinished().mutex);
  if (!flushed || std::rename(part_.c_str(), path_.c_str()) != 0)
    throw WorkError({path_}, "cannot be written (" + reason() + ")",
                    "free some space or choose another output");
  unfinished().names.erase(part_);
  part_.clear();
}

void remove_unfinished_files() {
  const std::lock_guard lock(unfinished().mutex);
  for (const std::string& name : unfinished().names) ::unlink(name.c_str());
}

void write_file(const std::string& path, const std::string& contents) {
  AtomicFile file(path);
  File out(std::fopen(file.temporary_path().c_str(), "wb"));
  if (!out || std::fwrite(contents.data(), 1, contents.size(), out.get()) != contents.size() ||
      std::fflush(out.get()) != 0)
    throw WorkError({path}, "cannot be written (" + reason() + ")",
                    "free some space or choose another output");
  out.reset();
  file.commit();
}

std::string read_file(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError({path}, "this is a folder", "name a file");
  File in(std::fopen(path.c_str(), "rb"));
  if (!in)
    throw InputError({path}, "cannot be read (" + reason() + ")", "check the name and its rights");
  std::string contents;
  const auto size = fs::file_size(path, error);
  if (!error) contents.reserve(size + 1);
  char buffer[1 << 16];
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, in.get())) > 0;) {
    contents.append(buffer, n);
    if (error && contents.size() > kLongestStream)
      throw InputError({path}, "this device or pipe does not end", "name an ordinary file");
  }
  if (std::ferror(in.get()))
    throw InputError({path}, "cannot be read (" + reason() + ")", "check the disk");
  return contents;
}

}  // namespace penumbra
