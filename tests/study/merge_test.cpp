#include "study/merge.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <vector>

#include "core/text_file.hpp"
#include "experiment/process_pool.hpp"
#include "experiment/record_file.hpp"
#include "nbvopt/core/error.hpp"
#include "study/record.hpp"
#include "study/study_fixture.hpp"
#include "study/study_run.hpp"
#include "support/error_message.hpp"

namespace nbvopt::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class MergedStudy : public testing::Test {
 protected:
  StudyFolder folder(const std::string& name) const { return {files.folder / name}; }

  StudyFolder run(const std::string& name, const Shard& shard = {}) const {
    return run(files.read(test::kSmallSpec), name, shard);
  }
  StudyFolder run(const Study& study, const std::string& name, const Shard& shard = {}) const {
    experiment::ProcessPool pool({NBVOPT_ODD_WORKER}, 2);
    run_study(study, folder(name), WorkKind::query, {.shard = shard}, pool, [](const Json&) {});
    return folder(name);
  }

  /// The records by their unit, without times; each unit is there once.
  static std::map<std::string, Json> records(const StudyFolder& of) {
    std::map<std::string, Json> result;
    experiment::for_each_record(of.records(), [&](const Json& record) {
      Json timeless = record;
      timeless.erase("times");
      EXPECT_TRUE(result.emplace(record_id(record), timeless).second);
    });
    return result;
  }

  /// Replaces the first such text in the folder's records.
  static void change_records(const StudyFolder& of, const std::string& from,
                             const std::string& to) {
    std::string text = read_text_file(of.records());
    const std::size_t place = text.find(from);
    ASSERT_NE(place, std::string::npos);
    std::ofstream(of.records(), std::ios::binary) << text.replace(place, from.size(), to);
  }

  const test::StudyFiles files;
};

TEST_F(MergedStudy, OfShardsIsTheWholeStudy) {
  const auto whole = records(run("whole"));
  std::vector<StudyFolder> shards;
  std::size_t units = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    shards.push_back(run("shard" + std::to_string(i), {i, 2}));
    const auto of_shard = records(shards.back());
    EXPECT_LT(of_shard.size(), whole.size());
    units += of_shard.size();
    const WorkCount count =
        count_work(files.read(test::kSmallSpec), shards.back(), WorkKind::query, {i, 2});
    EXPECT_EQ(count.total, of_shard.size());
    EXPECT_EQ(count.done, of_shard.size());
  }
  EXPECT_EQ(units, whole.size());

  const MergeCount count = merge_studies(shards, folder("merged"));
  EXPECT_EQ(count.records, whole.size());
  EXPECT_EQ(count.repeated, 0U);
  EXPECT_EQ(records(folder("merged")), whole);
  // It is a folder like that of a run: there is nothing left to do.
  const WorkCount work =
      count_work(files.read(test::kSmallSpec), folder("merged"), WorkKind::query);
  EXPECT_EQ(work.done, work.total);

  const MergeCount again = merge_studies(shards, folder("merged"));
  EXPECT_EQ(again.records, 0U);
  EXPECT_EQ(again.repeated, whole.size());
  EXPECT_EQ(records(folder("merged")), whole);
}

TEST_F(MergedStudy, TakesUpEqualRecordsOnce) {
  const StudyFolder a = run("a");
  const StudyFolder b = run("b", {1, 3});
  merge_studies(std::vector{b, a, b}, folder("merged"));
  const MergeCount count = merge_studies(std::vector{folder("merged"), b}, folder("merged"));
  EXPECT_EQ(count.records, 0U);
  EXPECT_EQ(records(folder("merged")), records(a));
}

TEST_F(MergedStudy, PrefersAnswersToFailures) {
  const StudyFolder good = run("good");
  const StudyFolder bad = run("bad");
  change_records(bad, "\"status\":", "\"failure\":\"took too long\",\"status\":");
  for (const auto& parts : {std::vector{good, bad}, std::vector{bad, good}}) {
    const StudyFolder into = folder("merged" + parts.front().root.filename().string());
    merge_studies(parts, into);
    std::map<std::string, Json> last;
    experiment::for_each_record(into.records(),
                                [&](const Json& record) { last[record_id(record)] = record; });
    for (const auto& [unit, record] : last) EXPECT_FALSE(record.contains("failure"));
    EXPECT_EQ(last.size(), records(good).size());
  }
}

TEST_F(MergedStudy, RefusesRecordsThatContradictEachOther) {
  const StudyFolder a = run("a");
  const StudyFolder b = run("b");
  change_records(b, "\"evaluations\":", "\"evaluations\":1");
  EXPECT_THAT(test::message_of<InputError>([&] {
                merge_studies(std::vector{a, b}, folder("c"));
              }),
              AllOf(HasSubstr(a.root.string()), HasSubstr(b.root.string()),
                    HasSubstr("says something else")));
  EXPECT_FALSE(std::filesystem::exists(folder("c").root)) << "nothing half-written";
}

TEST_F(MergedStudy, RefusesOtherStudies) {
  const StudyFolder a = run("a");
  std::string spec = test::kSmallSpec;
  const StudyFolder b = run(files.read(spec.replace(spec.find("0.5"), 3, "1.5")), "b");
  EXPECT_THAT(test::message_of<InputError>([&] {
                merge_studies(std::vector{a, b}, folder("c"));
              }),
              AllOf(HasSubstr(a.root.string()), HasSubstr(b.root.string()),
                    HasSubstr("motion_times_s differ")));
  EXPECT_THAT(test::message_of<InputError>([&] {
                merge_studies(std::vector{a, folder("none")}, folder("c"));
              }),
              HasSubstr("none"));
  EXPECT_FALSE(std::filesystem::exists(folder("c").root));
}

}  // namespace
}  // namespace nbvopt::study
