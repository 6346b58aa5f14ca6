// `nbvopt map build`, as a user types it.
#include <filesystem>

#include "cli/command_line.hpp"

namespace nbvopt::test {
namespace {

namespace fs = std::filesystem;

class MapBuildCommand : public ::testing::Test {
 protected:
  /// A recording in the layout of 7-Scenes; the last frame has no pose.
  MapBuildCommand() {
    for (int i = 0; i < 4; ++i) {
      const std::string name = "frame-00000" + std::to_string(i);
      std::string image = "P2\n4 3\n65535\n";
      for (int p = 0; p < 12; ++p) {
        image += p == 5 ? "65535 " : std::to_string(1400 + 10 * p + 50 * i) + " ";
      }
      folder.write(name + ".depth.png", image);
      const std::string x = std::to_string(0.1 * i);
      if (i < 3) {
        folder.write(name + ".pose.txt", "1 0 0 " + x + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
      }
    }
  }

  std::vector<std::string> building(const std::string& out) const {
    return {"map", "build", folder.path().string(), out, "--format", "7-scenes"};
  }

  TemporaryFolder folder;
};

TEST_F(MapBuildCommand, EqualsInsertionByHand) {
  auto command = building(folder / "built.ot");
  command.emplace_back("--json");
  const nlohmann::json told = nbvopt_json(command);
  EXPECT_EQ(told.at("frames_inserted"), 3);
  EXPECT_EQ(told.at("frames_without_pose"), 1);
  EXPECT_EQ(told.at("frames_resumed"), 0);
  EXPECT_EQ(told.at("points_used"), 3 * 11);
  for (const std::string frame : {"0", "1", "2"}) {
    EXPECT_EQ(nbvopt_run({"map", "insert", folder / "by_hand.ot",
                          folder / ("frame-00000" + frame + ".depth.png"), "--pose",
                          "0." + frame + ",0,0,0,0,0,1", "--create", "0.05", "--intrinsics",
                          "585,585,320,240", "--largest-value", "invalid"})
                  .exit_code,
              0);
  }
  const auto bytes = [&](const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(folder / name, std::ios::binary).rdbuf();
    return text.str();
  };
  EXPECT_TRUE(bytes("built.ot") == bytes("by_hand.ot"));
  EXPECT_FALSE(fs::exists(folder / "built.ot.partial"));
}

TEST_F(MapBuildCommand, OverwritesOnlyWhenTold) {
  const std::string out = folder.write("there.ot", "something of the user's");
  expect_refusal(nbvopt_run(building(out)), 3, "--overwrite");
  auto told = building(out);
  told.emplace_back("--overwrite");
  EXPECT_EQ(nbvopt_run(told).exit_code, 0);
}

TEST_F(MapBuildCommand, RefusesWhatNeverLiesInRange) {
  auto wrong = building(folder / "none.ot");
  wrong.insert(wrong.end(), {"--depth-scale", "1"});
  const ProcessResult result = nbvopt_run(wrong);
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, ::testing::HasSubstr("millimetres"));
  EXPECT_THAT(result.err, ::testing::HasSubstr("no frame could be inserted"));
  EXPECT_FALSE(fs::exists(folder / "none.ot"));
  auto no_camera = building(folder / "none.ot");
  no_camera.back() = "tum";
  expect_refusal(nbvopt_run(no_camera), 3, "depth");
}

}  // namespace
}  // namespace nbvopt::test
