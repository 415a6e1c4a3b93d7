#include "base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "base/error.h"

namespace penumbra {
namespace fs = std::filesystem;
namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string reason() { return std::strerror(errno); }

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  const fs::path folder = fs::path(path_).parent_path();
  std::error_code ignored;
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw WorkError({path_}, "the folder " + folder.string() + " does not exist",
                    "create it or choose another output");
  if (fs::is_directory(path_, ignored))
    throw WorkError({path_}, "this is a folder", "name a file for the output");
  temporary_ = path_ + ".part" + std::to_string(::getpid());
  const int fd = ::open(temporary_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0)
    throw WorkError({path_}, "cannot be written (" + reason() + ")", "choose another output");
  ::close(fd);
}

AtomicFile::~AtomicFile() {
  if (!committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  const int fd = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  const bool flushed = fd >= 0 && ::fsync(fd) == 0;
  if (fd >= 0) ::close(fd);
  if (!flushed || std::rename(temporary_.c_str(), path_.c_str()) != 0)
    throw WorkError({path_}, "cannot be written (" + reason() + ")",
                    "free some space or choose another output");
  committed_ = true;
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
  for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, in.get())) > 0;)
    contents.append(buffer, n);
  if (std::ferror(in.get()))
    throw InputError({path}, "cannot be read (" + reason() + ")", "check the disk");
  return contents;
}

}  // namespace penumbra
