#include "base/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "base/error.h"
#include "support/temporary_folder.h"

namespace penumbra {
namespace {

using test::TemporaryFolder;

std::string message_of(const std::string& path) {
  try {
    const AtomicFile file(path);
  } catch (const WorkError& error) {
    return error.what();
  }
  return {};
}

TEST(AtomicFile, AppearsOnlyWhenCommitted) {
  const TemporaryFolder folder;
  write_file(folder / "a", "old");
  {
    const AtomicFile file(folder / "a");
    std::FILE* out = std::fopen(file.temporary_path().c_str(), "wb");
    ASSERT_NE(out, nullptr);
    std::fputs("half", out);
    std::fclose(out);
    EXPECT_EQ(read_file(folder / "a"), "old");
    EXPECT_LE(folder.count(), 2) << "without O_TMPFILE it has a name";
  }
  EXPECT_EQ(folder.count(), 1);
  EXPECT_EQ(read_file(folder / "a"), "old");
  write_file(folder / "a", "new");
  EXPECT_EQ(read_file(folder / "a"), "new");
  EXPECT_EQ(folder.count(), 1);
}

TEST(AtomicFile, UnfinishedFilesCanBeRemovedAtAnEnd) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a");
  remove_unfinished_files();
  EXPECT_EQ(folder.count(), 0);
}

TEST(AtomicFile, AProcessThatIsKilledLeavesNothing) {
  const TemporaryFolder folder;
  const int probe = ::open((folder / ".").c_str(), O_TMPFILE | O_RDWR, 0666);
  if (probe < 0) GTEST_SKIP() << "this file system knows no files without a name";
  ::close(probe);
  const pid_t child = ::fork();
  if (child == 0) {
    const AtomicFile file(folder / "a");
    std::FILE* out = std::fopen(file.temporary_path().c_str(), "wb");
    std::fputs("half", out);
    std::fflush(out);
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WTERMSIG(status), SIGKILL);
  EXPECT_EQ(folder.count(), 0);
}

TEST(AtomicFile, HasTheRightsOfAnyNewFile) {
  const TemporaryFolder folder;
  write_file(folder / "a", "x");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &status), 0);
  const mode_t mask = ::umask(0);
  ::umask(mask);
  EXPECT_EQ(status.st_mode & 0777, 0666 & ~mask);
}

TEST(AtomicFile, RefusesWhatCannotBeReplaced) {
  const TemporaryFolder folder;
  ::mkdir((folder / "d").c_str(), 0777);
  EXPECT_EQ(message_of(folder / "d"),
            folder / "d" + ": this is a folder; name a file for the output");
  EXPECT_EQ(message_of("/dev/null"),
            "/dev/null: this is not an ordinary file; choose another output");
  EXPECT_EQ(message_of(folder / "no/a"), folder / "no/a" + ": the folder " + folder / "no" +
                                             " does not exist; create it or choose another output");
}

TEST(ReadFile, RefusesFoldersAndMissingFiles) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_file(folder / "."), InputError);
  EXPECT_THROW(read_file(folder / "none"), InputError);
}

TEST(ReadFile, KeepsEveryByte) {
  const TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes += static_cast<char>(i * 7);
  write_file(folder / "a", bytes);
  EXPECT_EQ(read_file(folder / "a"), bytes);
}

}  // namespace
}  // namespace penumbra
