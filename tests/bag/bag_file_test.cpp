#include "bag/bag_file.hpp"

#include <bzlib.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>

#include "bag/made_bag.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

test::MadeBag letters() {
  test::MadeBag bag;
  bag.add("/a", "std_msgs/String", "first");
  bag.add("/b", "std_msgs/Empty", std::string(5000, 'x'));
  bag.add("/a", "std_msgs/String", "");
  return bag;
}

std::string bz2_of(const std::string& bytes) {
  std::string packed(bytes.size() + 1000, '\0');
  auto size = static_cast<unsigned>(packed.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, const_cast<char*>(bytes.data()),
                                     static_cast<unsigned>(bytes.size()), 9, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}

std::string lz4_of(const std::string& bytes) {
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

class BagFileTest : public ::testing::Test {
 protected:
  std::string write(const std::string& bytes) const { return folder.write("a.bag", bytes); }

  std::string refusal(const std::string& bytes) const {
    const std::string path = write(bytes);
    return test::message_of<InputError>([&] { BagFile(path).for_each_message([](auto&&...) {}); });
  }

  test::TemporaryFolder folder;
};

TEST_F(BagFileTest, GivesMessagesInOrderHoweverTheyArePacked) {
  const test::MadeBag made = letters();
  for (const std::string& bytes :
       {made.file(), made.file("bz2", bz2_of(made.chunk())), made.file("lz4", lz4_of(made.chunk())),
        test::MadeBag::file_start() + made.chunk()}) {
    BagFile bag(write(bytes));
    std::vector<std::string> topics, messages;
    std::vector<BagPosition> places;
    bag.for_each_message(
        [&](const BagConnection& connection, std::string_view message, const BagPosition& where) {
          topics.push_back(connection.topic + " " + connection.type);
          messages.emplace_back(message);
          places.push_back(where);
        });
    EXPECT_THAT(topics,
                ElementsAre("/a std_msgs/String", "/b std_msgs/Empty", "/a std_msgs/String"));
    EXPECT_THAT(messages, ElementsAre("first", std::string(5000, 'x'), ""));
    for (const std::size_t i : {2U, 0U, 1U}) EXPECT_EQ(bag.message_at(places[i]), messages[i]);
  }
}

TEST_F(BagFileTest, SaysWhatElseAFileIs) {
  EXPECT_THAT(refusal("ply\nformat"), HasSubstr("is no rosbag"));
  EXPECT_THAT(refusal("#ROSBAG V1.2\n....."), HasSubstr("older format"));
  EXPECT_THAT(refusal("\x89MCAP0\r\n........"), HasSubstr("MCAP"));
  EXPECT_THAT(refusal("SQLite format 3\0....."), HasSubstr("ROS 2"));
  EXPECT_THAT(refusal("#ROSBAG V2.0\n" + test::bag_record('\x03', {{"encryptor", "gpg"}}, "")),
              HasSubstr("encrypted"));
}

TEST_F(BagFileTest, SaysWhereABagIsTruncatedOrDamaged) {
  const test::MadeBag made = letters();
  const std::string whole = made.file();
  EXPECT_THAT(refusal(whole.substr(0, whole.size() - 1)),
              AllOf(HasSubstr("a.bag"), HasSubstr("truncated"), HasSubstr("rosbag reindex")));
  std::string packed = bz2_of(made.chunk());
  packed[packed.size() / 2] ^= 1;
  EXPECT_THAT(refusal(made.file("bz2", packed)), HasSubstr("packed bytes are damaged"));
  EXPECT_THAT(refusal(made.file("bz2", bz2_of(made.chunk() + "more"))), HasSubstr("damaged"));
  EXPECT_THAT(refusal(made.file("lz4", lz4_of("less"))), HasSubstr("damaged"));
  EXPECT_THAT(refusal(made.file("zstd", "")), HasSubstr("'zstd'"));
  EXPECT_THAT(refusal(test::MadeBag::file_start() + test::bag_record('\x02', {}, "")),
              HasSubstr("not told of"));
}

/// What packs well claims no more memory than it says that it has.
TEST_F(BagFileTest, ABombIsRefused) {
  const std::string bomb = bz2_of(std::string(std::size_t{64} << 20, '\0'));
  EXPECT_THAT(refusal(letters().file("bz2", bomb)), HasSubstr("damaged"));
}

TEST_F(BagFileTest, NoChangedByteCrashes) {
  const test::MadeBag made = letters();
  std::uint64_t random = 1;
  for (const std::string& whole : {made.file(), made.file("lz4", lz4_of(made.chunk())),
                                   made.file("bz2", bz2_of(made.chunk()))}) {
    for (int i = 0; i < 100; ++i) {
      random = random * 6364136223846793005U + 1442695040888963407U;
      std::string bytes = whole;
      bytes[(random >> 33) % std::min<std::size_t>(bytes.size(), 400)] =
          static_cast<char>(random >> 56);
      if (i % 3 == 0) bytes.resize((random >> 20) % bytes.size());
      refusal(bytes + "x");
    }
  }
}

}  // namespace
}  // namespace nbvopt
