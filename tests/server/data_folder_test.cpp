#include "server/data_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

#include "core/text_file.hpp"
#include "server/call_status.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class DataFolderTest : public ::testing::Test {
 protected:
  DataFolderTest() {
    fs::create_directories(folder / "data/maps");
    folder.write("secret", "secret");
    folder.write("data/maps/a.ot", "a");
    fs::create_symlink(folder / "secret", folder / "data/link");
    fs::create_symlink(folder.path(), folder / "data/out");
    fs::create_symlink("maps", folder / "data/in");
  }

  std::string refusal_to_open(const std::string& path) const {
    return test::message_of<RequestError>([&] { DataFolder(folder / "data").open(path); });
  }
  std::string refusal_to_write(const std::string& path) const {
    return test::message_of<RequestError>(
        [&] { DataFolder(folder / "data").write(path, SharedBytes("new")); });
  }

  test::TemporaryFolder folder;
};

TEST_F(DataFolderTest, ReadsAndWritesBelowIt) {
  const DataFolder data(folder / "data");
  EXPECT_TRUE(data.open("maps/a.ot").is_open());
  EXPECT_TRUE(data.open("./maps//a.ot").is_open());
  data.write("maps/b.ot", SharedBytes("b"));
  data.write("maps/b.ot", SharedBytes("c"));
  EXPECT_EQ(read_text_file(folder / "data/maps/b.ot"), "c");
}

TEST_F(DataFolderTest, LetsNobodyOut) {
  for (const std::string path : {"../secret", "maps/../../secret", "maps/..", "/etc/passwd", "link",
                                 "out/secret", "in/a.ot"}) {
    EXPECT_NE(refusal_to_open(path), "") << path;
    EXPECT_NE(refusal_to_write(path), "") << path;
  }
  EXPECT_NE(refusal_to_open(std::string("maps/a.ot\0.png", 14)), "");
  EXPECT_EQ(read_text_file(folder / "secret"), "secret");
  EXPECT_TRUE(fs::is_symlink(folder / "data/link"));
}

TEST_F(DataFolderTest, TellsAFullDiskFromABadRequest) {
  // A file size limit stands for a full disk: what is beyond it is refused.
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  const rlimit small{.rlim_cur = 16, .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  grpc::StatusCode code = grpc::StatusCode::OK;
  try {
    DataFolder(folder / "data").write("maps/a.ot", SharedBytes(std::string(1000, 'x')));
  } catch (const RequestError& error) {
    code = error.code();
  }
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(code, grpc::StatusCode::DATA_LOSS);
  EXPECT_EQ(read_text_file(folder / "data/maps/a.ot"), "a") << "what was there stays";
}

TEST_F(DataFolderTest, WritesOutAZeroByteOfAName) {
  const std::string name("maps/a\0b/c.ot", 13);
  EXPECT_THAT(refusal_to_write(name), AllOf(HasSubstr("maps/a\\0b"), HasSubstr("': ")));
}

TEST_F(DataFolderTest, SaysWhatIsWrongWithoutTellingWhereItIs) {
  EXPECT_THAT(refusal_to_open("maps/none.ot"),
              AllOf(HasSubstr("'maps/none.ot'"), HasSubstr("No such file"),
                    Not(HasSubstr(folder.path().string()))));
  EXPECT_THAT(refusal_to_open("maps"), HasSubstr("not a file"));
  EXPECT_THAT(refusal_to_open(""), HasSubstr("name a file"));
  EXPECT_THAT(refusal_to_open("maps/"), HasSubstr("name a file"));
  EXPECT_THAT(refusal_to_write("none/a.ot"), HasSubstr("No such file"));
  EXPECT_THAT(refusal_to_write("maps"), HasSubstr("'maps': not a file"));
  ASSERT_EQ(::mkfifo((folder / "data/pipe").c_str(), 0600), 0);
  EXPECT_THAT(refusal_to_write("pipe"), HasSubstr("not a file"));
  EXPECT_THAT(refusal_to_open("pipe"), HasSubstr("not a file"));
}

TEST_F(DataFolderTest, KeepsTheSnapshot) {
  const std::string kept = folder.write("data/snapshot.ot", "kept");
  const DataFolder data(folder / "data", {kept});
  EXPECT_THAT(
      test::message_of<RequestError>([&] { data.write("snapshot.ot", SharedBytes("new")); }),
      HasSubstr("own file"));
  EXPECT_EQ(read_text_file(kept), "kept");
  EXPECT_TRUE(data.open("snapshot.ot").is_open());
}

TEST_F(DataFolderTest, MustBeThere) {
  EXPECT_THAT(test::message_of<InputError>([&] { DataFolder missing(folder / "none"); }),
              HasSubstr("cannot be the data folder"));
}

}  // namespace
}  // namespace nbvopt
