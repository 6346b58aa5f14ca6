#include <algorithm>
#include <filesystem>

#include "cli/query_command.hpp"
#include "core/text_file.hpp"

namespace nbvopt::test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class View : public CommandLine {
 protected:
  /// Asks where to look, and gives the answer's file.
  std::string answer() {
    const std::string file = folder / "answer.json";
    EXPECT_EQ(nbvopt_run(query(map_file, {"--json-out", file})).exit_code, 0);
    return file;
  }

  /// Refused, and nothing written.
  void expect_no_page(const Arguments& arguments, int exit_code, const std::string& named) {
    Arguments all{"view", map_file, "-o", page_file};
    all.insert(all.end(), arguments.begin(), arguments.end());
    expect_refusal(nbvopt_run(all), exit_code, named);
    EXPECT_FALSE(std::filesystem::exists(page_file));
  }

  const std::string page_file = folder / "view.html";
};

TEST_F(View, OfAMapIsAPage) {
  const ProcessResult result = nbvopt_run({"view", map_file, "-o", page_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, MatchesRegex(".*view.html: 1310 faces in 10 rectangles, .* MB\n"));
  EXPECT_THAT(read_text_file(page_file), Not(HasSubstr("T_map_sensor\":")));
}

TEST_F(View, ShowsAnAnswer) {
  const ProcessResult result =
      nbvopt_run({"view", map_file, "--answer", answer(), "--out", page_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(read_text_file(page_file), HasSubstr("T_map_sensor\":"));
}

TEST_F(View, TellsThatAnAnswerIsToSomethingElse) {
  const ProcessResult result =
      nbvopt_run({"view", map_file, "--answer", answer(), "--gain", "expected", "-o", page_file});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("give the map, the robot and the gain that the answer is for"));
}

TEST_F(View, ShowsAnEpisode) {
  const std::string metrics = folder.write(
      "m.jsonl",
      R"({"time_s": 0, "base": [0, 0, 0, 0], "pan": 0, "tilt": 0, "height": 0.4, "information": 1,
          "predicted_gain": null, "realised_gain": null})");
  const ProcessResult split = nbvopt_run({"view", map_file, "--episode", metrics, "-o", page_file});
  expect_refusal(split, 3, "m.jsonl: line 1: not valid JSON");
  std::string line = read_text_file(metrics);
  line.erase(std::remove(line.begin(), line.end(), '\n'), line.end());
  folder.write("m.jsonl", line);
  const ProcessResult result =
      nbvopt_run({"view", map_file, "--episode", metrics, "-o", page_file});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(read_text_file(page_file), HasSubstr("\"episode\":{\"captures\":1}"));
}

TEST_F(View, OfABoxHasItsFacesAlone) {
  // Of the wall 3 x 3 voxels: their fronts, their backs, and three from below.
  const ProcessResult result =
      nbvopt_run({"view", map_file, "--box", "3,0.25,0.25,1.85,0.05,0.05", "-o", page_file});
  EXPECT_THAT(result.out, HasSubstr(": 21 faces in 3 rectangles"));
}

TEST_F(View, RefusesWhatItCannotShow) {
  expect_no_page({"--box", "1,2,3"}, 2, "X0,Y0,Z0,X1,Y1,Z1");
  expect_no_page({"--answer", folder / "none.json"}, 3, "none.json");
  expect_no_page({"--answer", map_file}, 3, "not valid JSON");
  expect_no_page({"--episode", map_file}, 3, "line 1: not valid JSON");
  expect_no_page({"--answer", folder.write("a.json", "{}")}, 3, "'request' is missing");
  expect_refusal(nbvopt_run({"view", map_file}), 2, "--out is required");
  expect_refusal(nbvopt_run({"view", map_file, "-o", folder / "none/view.html"}), 3, "none");
}

}  // namespace
}  // namespace nbvopt::test
