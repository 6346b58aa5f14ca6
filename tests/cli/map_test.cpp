// `nbvopt map`: counts, conversion and insertion, as a user types them.
#include <fstream>
#include <sstream>

#include "cli/command_line.hpp"

namespace nbvopt::test {
namespace {

std::string bytes_of(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

class MapCommand : public CommandLine {
 protected:
  MapCommand() {
    std::ofstream(cloud_file) << "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                                 "property float y\nproperty float z\nend_header\n"
                                 "0 0 1.5\n0.1 0 1.5\n";
  }

  /// Inserts the cloud from a camera in the room that looks along x.
  std::vector<std::string> insertion(const std::string& map) const {
    return {"map", "insert", map, cloud_file, "--pose", "-1.05,0.05,0.55,-0.5,0.5,-0.5,0.5"};
  }

  const std::string cloud_file = folder / "cloud.ply";
};

TEST_F(MapCommand, InfoCountsVoxels) {
  const nlohmann::json info = nbvopt_json({"map", "info", map_file, "--json"});
  EXPECT_EQ(info.at("occupied_voxels"), 40 * 15);
  EXPECT_EQ(info.at("free_voxels"), 39 * 40 * 15);
  EXPECT_NEAR(info.at("information"), 40 * 15 * 0.2, 1e-3);
}

TEST_F(MapCommand, ConvertsToEveryFormat) {
  for (const std::string name : {"room.bt", "copy.ot", "room.ply", "room.pcd", "room.pgm"}) {
    EXPECT_EQ(nbvopt_run({"map", "convert", map_file, folder / name}).exit_code, 0) << name;
  }
  EXPECT_EQ(nbvopt_run({"map", "convert", map_file, folder / "colour.ot", "--format", "colour-ot"})
                .exit_code,
            0);
  EXPECT_EQ(bytes_of(folder / "copy.ot"), bytes_of(map_file));
  EXPECT_EQ(bytes_of(folder / "room.ply").substr(0, 4), "ply\n");
  EXPECT_NE(bytes_of(folder / "room.pcd").find("\nDATA binary\n"), std::string::npos);
  EXPECT_EQ(bytes_of(folder / "room.pgm").substr(0, 3), "P5\n");
  EXPECT_NE(bytes_of(folder / "room.yaml").find("image: 'room.pgm'"), std::string::npos);
  for (const std::string name : {"room.bt", "colour.ot"}) {
    EXPECT_EQ(nbvopt_json({"map", "info", folder / name, "--json"}).at("occupied_voxels"), 40 * 15)
        << name;
  }
}

TEST_F(MapCommand, ConvertRefusesWhatAFormatDoesNotHeed) {
  const auto refusal = [&](const std::string& out, const std::vector<std::string>& options) {
    std::vector<std::string> arguments{"map", "convert", map_file, folder / out};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const auto result = nbvopt_run(arguments);
    EXPECT_EQ(result.exit_code, 2) << out;
    EXPECT_FALSE(std::filesystem::exists(folder / out));
    return result.err;
  };
  EXPECT_THAT(refusal("a.ply", {"--height-band", "0,1"}), ::testing::HasSubstr("floor plans"));
  EXPECT_THAT(refusal("a.pgm", {"--all-points"}), ::testing::HasSubstr("of points"));
  EXPECT_THAT(refusal("a.pgm", {"--height-band", "1"}), ::testing::HasSubstr("Z0,Z1"));
  EXPECT_THAT(refusal("a.bt", {"--message", "OcTree,0.1"}), ::testing::HasSubstr("ID,RES,binary"));
  EXPECT_THAT(refusal("a.bt", {"--message", "OcTree,0.1,maybe"}),
              ::testing::HasSubstr("ID,RES,binary"));
  EXPECT_THAT(refusal("a.bt", {"--message", "OcTree,much,full"}), ::testing::HasSubstr("much"));
}

TEST_F(MapCommand, ReadsTheDataOfAMessage) {
  ASSERT_EQ(nbvopt_run({"map", "convert", map_file, folder / "room.bt"}).exit_code, 0);
  const std::string file = bytes_of(folder / "room.bt");
  std::ofstream(folder / "data.bin") << file.substr(file.find("\ndata\n") + 6);
  const nlohmann::json info =
      nbvopt_json({"map", "info", folder / "data.bin", "--message", "OcTree,0.1,binary", "--json"});
  EXPECT_EQ(info.at("occupied_voxels"), 40 * 15);
}

TEST_F(MapCommand, TellsWhatCouldNotBeTakenAsItStands) {
  std::string file = bytes_of(map_file);
  const std::size_t size = file.find("\nsize ");
  file.erase(size, file.find('\n', size + 1) - size);
  std::ofstream(folder / "placeholder.ot") << file;
  const auto result = nbvopt_run({"map", "info", folder / "placeholder.ot"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, ::testing::HasSubstr("placeholder.ot: the header has no 'size'"));
}

TEST_F(MapCommand, InsertsIntoTheMapOrBesideIt) {
  const std::string before = bytes_of(map_file);
  auto beside = insertion(map_file);
  beside.insert(beside.end(), {"--out", folder / "after.ot"});
  EXPECT_EQ(nbvopt_run(beside).exit_code, 0);
  EXPECT_EQ(bytes_of(map_file), before);
  EXPECT_NE(bytes_of(folder / "after.ot"), before);

  EXPECT_EQ(nbvopt_run(insertion(map_file)).exit_code, 0);
  EXPECT_EQ(bytes_of(map_file), bytes_of(folder / "after.ot"));
}

TEST_F(MapCommand, KeepsTheMapBeforeUnlessToldToOverwrite) {
  const std::string before = bytes_of(map_file);
  auto inserting = insertion(map_file);
  inserting.emplace_back("--json");
  EXPECT_EQ(nbvopt_json(inserting).at("backup"), map_file + ".bak");
  EXPECT_EQ(bytes_of(map_file + ".bak"), before);

  inserting.emplace_back("--overwrite");
  EXPECT_EQ(nbvopt_json(inserting).at("backup"), nullptr);
  EXPECT_EQ(bytes_of(map_file + ".bak"), before) << "the older backup stays";

  auto beside = insertion(map_file);
  beside.insert(beside.end(), {"--out", folder / "after.ot", "--json"});
  EXPECT_EQ(nbvopt_json(beside).at("backup"), nullptr) << "there was no such file";
}

TEST_F(MapCommand, RefusesAScanThatCanOnlyClear) {
  const std::string before = bytes_of(map_file);
  std::ofstream(cloud_file) << "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                               "property float y\nproperty float z\nend_header\n"
                               "0 0 1500\n100 0 1500\n";
  expect_refusal(nbvopt_run(insertion(map_file)), 3, "millimetres");
  std::ofstream(cloud_file) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                               "property float y\nproperty float z\nend_header\n"
                               "0 0 4.5\n0.1 0 4.5\n0 0 nan\n";
  expect_refusal(nbvopt_run(insertion(map_file)), 3, "--clear-only");
  EXPECT_EQ(bytes_of(map_file), before);
  EXPECT_FALSE(std::ifstream(map_file + ".bak").is_open());

  auto meant = insertion(map_file);
  meant.insert(meant.end(), {"--clear-only", "--json"});
  const nlohmann::json told = nbvopt_json(meant);
  EXPECT_EQ(told.at("points_used"), 0);
  EXPECT_EQ(told.at("points_too_far"), 2);
  EXPECT_EQ(told.at("points_too_near"), 0);
  EXPECT_EQ(told.at("no_returns"), 0);
  EXPECT_EQ(told.at("points_not_finite"), 1);
  EXPECT_EQ(told.at("rays_cleared"), 2);
}

TEST_F(MapCommand, CreatesAMapOnlyWhenAsked) {
  const std::string file = folder / "new.ot";
  expect_refusal(nbvopt_run(insertion(file)), 3, "new.ot");
  auto creating = insertion(file);
  creating.insert(creating.end(), {"--create", "0.05"});
  EXPECT_EQ(nbvopt_run(creating).exit_code, 0);
  EXPECT_GT(nbvopt_json({"map", "info", file, "--json"}).at("occupied_voxels"), 0);
}

TEST_F(MapCommand, RefusalsLeaveTheMapAsItWas) {
  const std::string before = bytes_of(map_file);
  auto bad_pose = insertion(map_file);
  bad_pose.back() = "0,0,0,0,0,0,0";
  expect_refusal(nbvopt_run(bad_pose), 3, "length zero");
  bad_pose.back() = "0,0,nan,0,0,0,1";
  EXPECT_NE(nbvopt_run(bad_pose).exit_code, 0);
  expect_refusal(
      nbvopt_run({"map", "insert", map_file, folder / "none.ply", "--pose", "0,0,0,0,0,0,1"}), 3,
      "none.ply");
  auto no_folder = insertion(map_file);
  no_folder.insert(no_folder.end(), {"--out", folder / "missing/after.ot"});
  expect_refusal(nbvopt_run(no_folder), 3, "missing");
  EXPECT_EQ(bytes_of(map_file), before);
}

}  // namespace
}  // namespace nbvopt::test
