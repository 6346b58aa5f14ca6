#include "core/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class AtomicFile : public ::testing::Test {
 protected:
  static std::string refusal(const std::string& path) {
    return test::message_of<InputError>([&] { write_file_atomically(path, "new"); });
  }

  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
  }

  test::TemporaryFolder folder;
};

TEST_F(AtomicFile, IsWrittenAndReplaced) {
  const std::string path = folder / "file";
  write_file_atomically(path, "old");
  EXPECT_EQ(read_text_file(path), "old");
  write_file_atomically(path, std::string_view("n\0w", 3));
  EXPECT_EQ(read_text_file(path), std::string("n\0w", 3));
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFile, KeepsThePermissionsOfWhatItReplaces) {
  const std::string path = folder.write("file", "old");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  write_file_atomically(path, "new");
  EXPECT_EQ(fs::status(path).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(AtomicFile, FollowsALink) {
  const std::string target = folder.write("target", "old");
  fs::create_symlink(target, folder / "link");
  write_file_atomically(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read_text_file(target), "new");
}

TEST_F(AtomicFile, RefusesAFolderThatIsMissing) {
  const std::string path = folder / "none/file";
  EXPECT_THAT(refusal(path), StartsWith(path + ": "));
  EXPECT_THAT(refusal(path), HasSubstr("no folder"));
}

TEST_F(AtomicFile, RefusesAFolderForAFile) {
  EXPECT_THAT(refusal(folder.path().string()), HasSubstr("is a folder"));
}

TEST_F(AtomicFile, RefusesAFullDisk) {
  EXPECT_THAT(refusal("/dev/full"), HasSubstr("No space left"));
}

TEST_F(AtomicFile, KeepsOneBackupOfWhatItReplaces) {
  const std::string path = folder / "file";
  write_file_with_backup(path, "first");
  EXPECT_EQ(files(), 1U) << "nothing was replaced";
  for (const std::string content : {"second", "third"}) {
    const std::string before = read_text_file(path);
    write_file_with_backup(path, content);
    EXPECT_EQ(read_text_file(path), content);
    EXPECT_EQ(read_text_file(backup_of(path).string()), before);
    EXPECT_EQ(files(), 2U);
  }
}

TEST_F(AtomicFile, KeepsTheBackupBesideWhatALinkLeadsTo) {
  const std::string path = folder.write("file", "old");
  fs::create_symlink(path, folder / "link");
  write_file_with_backup(folder / "link", "new");
  EXPECT_EQ(read_text_file(path), "new");
  EXPECT_EQ(read_text_file(path + ".bak"), "old");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

TEST_F(AtomicFile, LosesNoBackupWhenItCannotWrite) {
  const std::string path = folder.write("file", "old");
  fs::create_directories(folder / "file.bak/full");
  EXPECT_THAT(test::message_of<InputError>([&] { write_file_with_backup(path, "new"); }),
              HasSubstr("cannot be written"));
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files(), 2U);
}

TEST_F(AtomicFile, LeavesNothingBehindWhenItFails) {
  const std::string path = folder.write("file", "old");
  fs::create_directory(folder / "folder");
  refusal(folder / "folder");
  refusal(path + "/file");
  EXPECT_EQ(read_text_file(path), "old");
  EXPECT_EQ(files(), 2U);
}

}  // namespace
}  // namespace nbvopt
