#include "experiment/record_file.hpp"

#include <gmock/gmock.h>
#include <sys/resource.h>

#include <csignal>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt::experiment {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<int> numbers_in(const std::string& file) {
  std::vector<int> numbers;
  for_each_record(file,
                  [&numbers](const Json& record) { numbers.push_back(record.at("n").get<int>()); });
  return numbers;
}

TEST(RecordFile, Grows) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "records.jsonl";
  EXPECT_THAT(numbers_in(file), ElementsAre());
  RecordFile(file).append({{"n", 1}});
  RecordFile records(file);
  records.append({{"n", 2}});
  records.append({{"n", 3}});
  EXPECT_THAT(numbers_in(file), ElementsAre(1, 2, 3));
}

class TornRecordFile : public testing::TestWithParam<std::string> {};

TEST_P(TornRecordFile, IsRepaired) {
  const test::TemporaryFolder folder;
  const std::string whole = "{\"n\":1}\n{\"n\":2}\n";
  const std::string file = folder.write("records.jsonl", whole + GetParam());
  EXPECT_THAT(numbers_in(file), ElementsAre(1, 2));
  RecordFile(file).append({{"n", 3}});
  EXPECT_EQ(read_text_file(file), whole + "{\"n\":3}\n");
}

INSTANTIATE_TEST_SUITE_P(All, TornRecordFile,
                         testing::Values("", "{", "{\"n\":3", "{\"n\":3}",
                                         std::string(100'000, 'x'), std::string(3, '\0')));

TEST(RecordFile, OfATornLineAloneIsEmptied) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("records.jsonl", "{\"n\":");
  RecordFile(file).append({{"n", 1}});
  EXPECT_THAT(numbers_in(file), ElementsAre(1));
}

TEST(RecordFile, NamesALineThatIsDamaged) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("records.jsonl", "{\"n\":1}\n{\"n\"\n{\"n\":3}\n");
  EXPECT_THAT(test::message_of<InputError>([&] { numbers_in(file); }),
              AllOf(HasSubstr("records.jsonl: line 2"), HasSubstr("is no record")));
  const std::string other = folder.write("other.jsonl", "{\"m\":1}\n");
  EXPECT_THAT(test::message_of<InputError>([&] { numbers_in(other); }), HasSubstr("line 1"));
}

TEST(RecordFile, EndsWithAWholeRecordWhenTheDiskIsFull) {
  const test::TemporaryFolder folder;
  const std::string file = folder / "records.jsonl";
  RecordFile records(file);
  records.append({{"n", 1}});
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{100, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &tight);
  const std::string message = test::message_of<InputError>([&] {
    records.append({{"n", 2}, {"text", std::string(200, 'x')}});
  });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, AllOf(HasSubstr("records.jsonl"), HasSubstr("cannot be written")));
  EXPECT_EQ(read_text_file(file), "{\"n\":1}\n");
  records.append({{"n", 3}});
  EXPECT_THAT(numbers_in(file), ElementsAre(1, 3));
}

}  // namespace
}  // namespace nbvopt::experiment
