#include "base/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

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
    EXPECT_EQ(folder.count(), 2);
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
  EXPECT_THROW(file.commit(), WorkError);
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
