// Episodes as a user runs them, in the office that ships.
#include <csignal>
#include <filesystem>
#include <sstream>

#include "cli/command_line.hpp"
#include "core/text_file.hpp"
#include "nbvopt/sim/trajectory.hpp"
#include "support/background_process.hpp"
#include "support/paths.hpp"
#include "support/wait_until.hpp"

namespace nbvopt::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using Arguments = std::vector<std::string>;

const std::string kOffice = datasets_dir() / "office.world";

class Simulate : public ::testing::Test {
 protected:
  /// The arguments of an episode of two seconds through the office's corridor, a coarse camera on
  /// the robot, with these added.
  Arguments episode(const Arguments& more = {}) const {
    Arguments arguments{"simulate",     kOffice, "--no-cache", "--no-progress",
                        "--trajectory", drive_,  "--robot",    robot_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  /// The arguments of a drive from the corridor's west end.
  static Arguments drive(const Arguments& more = {}) {
    Arguments arguments{"simulate", kOffice, "--no-cache", "--no-progress", "--explore-only"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  static json without_times(json summary) {
    summary.erase("times_ms");
    return summary;
  }

  /// With a coarse camera.
  const std::string& robot() const { return robot_; }

  TemporaryFolder folder;

 private:
  std::string drive_ = folder.write(
      "drive.csv", "time_s,x_m,y_m,z_m,yaw_rad\n0,0.617,0.713,0,0\n2,1.117,0.713,0,0\n");
  std::string robot_ =
      folder.write("robot.yaml", "sensor: {horizontal_pixels: 96, vertical_pixels: 72}\n");
};

TEST_F(Simulate, LetsActorsWalkUnlessTheyAreLeftOut) {
  const auto room_with_an_actor = [&](const std::string& pose) {
    return folder.write(
        "room.world",
        "<sdf version='1.6'><world name='w'><model name='m'><link name='l'><visual name='v'><pose>"
        "0 0 1 0 0 0</pose><geometry><box><size>6 6 2.5</size></box></geometry></visual></link>"
        "</model><actor name='a'><pose>" +
            pose + "</pose></actor></world></sdf>");
  };
  const auto simulated = [&](const std::string& world, const Arguments& more) {
    Arguments arguments = episode({"--json", "--mode", "static"});
    arguments[1] = world;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  const std::string world = room_with_an_actor("2.2 0.7 0.8 0 0 0");
  EXPECT_GT(nbvopt_json(simulated(world, {}))["ghosts"], 10);
  EXPECT_TRUE(nbvopt_json(simulated(world, {"--without-people"}))["ghosts"].is_null());
  const std::string in_the_wall = room_with_an_actor("2.9 0.7 0.8 0 0 0");
  expect_refusal(nbvopt_run(simulated(in_the_wall, {})), 3,
                 "actor 'a' stands in or at a wall or a piece of furniture at (2.9, 0.7)");
}

TEST_F(Simulate, WritesAllThatAnEpisodeLeavesBehind) {
  const std::string map_file = folder / "map.ot";
  const std::string metrics_file = folder / "metrics.jsonl";
  const std::string summary_file = folder / "summary.json";
  const std::string plot_file = folder / "plot.png";
  const json answer = nbvopt_json(
      episode({"--json", "--map-out", map_file, "--metrics", metrics_file, "--summary",
               summary_file, "--plot", plot_file, "--motion-time", "0.5", "--mode", "auto"}));
  EXPECT_EQ(json::parse(read_text_file(summary_file)), answer);
  EXPECT_EQ(answer["captures"], 5);
  EXPECT_EQ(answer["duration_s"], 2.0);
  const MapCounts counts = read_map(map_file).counts();
  EXPECT_EQ(answer["voxels"], counts.certain_voxels);
  EXPECT_NEAR(answer["information"], counts.information, 1e-6);
  EXPECT_GT(answer["voxels_as_paper_counts"], 0);

  const std::vector<json> captures = lines_of(metrics_file);
  ASSERT_EQ(captures.size(), 5U);
  EXPECT_TRUE(captures.front()["predicted_gain"].is_null());
  EXPECT_EQ(captures.back()["information"], answer["information"]);
  EXPECT_EQ(captures.back()["time_s"], 2.0);
  double predicted = 0.0;
  for (std::size_t i = 1; i < captures.size(); ++i) {
    predicted += captures[i]["predicted_gain"].get<double>();
  }
  EXPECT_NEAR(answer["prediction"]["predicted_sum"], predicted, 1e-9);
  EXPECT_EQ(read_text_file(plot_file).substr(1, 3), "PNG");
}

TEST_F(Simulate, TellsPeopleWhatCameOut) {
  const ProcessResult result = nbvopt_run(episode({"--mode", "grid"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("5 captures in 2.0 s of driving"));
  EXPECT_THAT(result.out, HasSubstr("voxels with u < 1"));
  EXPECT_EQ(result.err, "");
}

TEST_F(Simulate, AnswersTheSameOnAnyNumberOfThreads) {
  for (const char* mode : {"static", "grid-3", "auto", "random"}) {
    const auto summary = [&](const char* threads) {
      return without_times(nbvopt_json(episode({"--json", "--mode", mode, "--threads", threads})));
    };
    EXPECT_EQ(summary("1"), summary("3")) << mode;
  }
}

TEST_F(Simulate, TellsWhatPosesAndMapAreWorth) {
  const auto summary = [&](const char* source, const char* threads) {
    return without_times(nbvopt_json(
        episode({"--json", "--mode", "grid", "--pose-source", source, "--threads", threads})));
  };
  const json slam = summary("slam", "1");
  EXPECT_EQ(slam, summary("slam", "3"));
  EXPECT_EQ(slam["pose_source"], "slam");
  EXPECT_GT(slam["localisation"]["position_error_m"]["largest"], 0.0);
  EXPECT_GT(slam["localisation"]["scans"], 0);
  EXPECT_LE(slam["map_score"]["precision"], 1.0);
  EXPECT_LE(slam["map_score"]["true_information"], slam["information"]);
  const json truth = summary("truth", "1");
  EXPECT_TRUE(truth["localisation"].is_null());
  EXPECT_TRUE(truth["map_score"].is_null());
  EXPECT_THAT(nbvopt_run(episode({"--score-map", "--mode", "static"})).out,
              HasSubstr("100.0 % of the occupied voxels are at a surface (precision), 100.0 %"));
}

TEST_F(Simulate, ReplaysTheDriveThatItMade) {
  const std::string file = folder / "made.csv";
  const json made = nbvopt_json(drive({"--json", "--start", "0.617,0.713,0", "--goal", "1.3,0.8",
                                       "--goal", "1.1,0.7", "--trajectory-out", file}));
  EXPECT_EQ(made["status"], "complete");
  EXPECT_GT(made["length_m"], 0.7);
  const json replayed = nbvopt_json({"simulate", kOffice, "--no-cache", "--no-progress",
                                     "--trajectory", file, "--mode", "static", "--json"});
  EXPECT_EQ(replayed["duration_s"], made["duration_s"]);
}

TEST_F(Simulate, ExploresUntilItMustEnd) {
  const json made =
      nbvopt_json(drive({"--json", "--start", "0.617,0.713,0", "--duration-max", "4"}));
  EXPECT_EQ(made["status"], "time_limit");
  EXPECT_NEAR(made["duration_s"], 4.0, 0.1);
}

TEST_F(Simulate, KeepsTheDriveThatASignalEnds) {
  const std::string file = folder / "stopped.csv";
  const std::string log = folder / "stopped.log";
  BackgroundProcess process(
      cli_program(), drive({"--explore", "nbv", "--robot", robot(), "--trajectory-out", file}),
      log);
  ASSERT_TRUE(wait_until([&] { return std::filesystem::file_size(log) > 0; }))
      << "it says where it starts";
  process.send(SIGINT);
  EXPECT_EQ(process.wait(), -1) << "it ends by the signal";
  EXPECT_THAT(read_text_file(log), HasSubstr("stopped; the drive so far is in " + file));
  const Trajectory kept = read_trajectory(file);
  EXPECT_GT(kept.duration_s(), 0.0);
  EXPECT_LT(kept.duration_s(), 100.0) << "it would explore for longer";
}

TEST_F(Simulate, KeepsTheMapOfAnEpisodeThatTheDiskEnded) {
  const std::string map_file = folder / "map.ot";
  expect_refusal(nbvopt_run(episode({"--map-out", map_file, "--metrics", "/dev/full"})), 3,
                 "/dev/full: cannot be written: No space left on device");
  EXPECT_GT(read_map(map_file).counts().information, 0.0);
  expect_refusal(nbvopt_run(episode({"--map-out", "/dev/full", "--metrics", "/dev/full"})), 3,
                 "nor is the map kept");
}

TEST_F(Simulate, RefusesAWrongCommandLine) {
  expect_refusal(nbvopt_run(episode({"--start", "0,0,0"})), 2, "--trajectory holds the whole");
  expect_refusal(nbvopt_run(episode({"--explore-only"})), 2, "--explore-only");
  expect_refusal(nbvopt_run(drive({"--start", "1,1,0", "--map-out", folder / "map.ot"})), 2,
                 "--explore-only maps nothing");
  expect_refusal(nbvopt_run(episode({"--mode", "clever"})), 2, "no camera mode 'clever'");
  expect_refusal(nbvopt_run(drive({"--start", "0,0"})), 2, "X,Y,YAW");
  expect_refusal(nbvopt_run(drive({"--explore", "4d"})), 2, "--explore: 4d not in {2d");
  expect_refusal(nbvopt_run(episode({"--explore", "2d"})), 2, "--explore chooses where");
  expect_refusal(nbvopt_run(drive({"--explore", "2d", "--goal", "1,1"})), 2, "--explore chooses");
  expect_refusal(nbvopt_run(episode({"--pose-source", "gps"})), 2,
                 "--pose-source: gps not in {truth,odom,slam}");
  expect_refusal(nbvopt_run(drive({"--start", "1,1,0", "--pose-source", "slam"})), 2,
                 "--explore-only drives with the true pose");
}

TEST_F(Simulate, RefusesWhatCannotBeRun) {
  expect_refusal(nbvopt_run({"simulate", folder / "no.world", "--start", "0,0,0"}), 3, "no.world");
  expect_refusal(nbvopt_run(episode({"--motion-time", "0"})), 3, "motion time");
  expect_refusal(nbvopt_run(episode({"--range-noise", "-1"})), 3, "range noise");
  expect_refusal(nbvopt_run(episode({"--resolution", "0"})), 3, "resolution");
  expect_refusal(nbvopt_run(episode({"--height", "3"})), 3, "height");
  expect_refusal(nbvopt_run(episode({"--odometry-noise", "-1"})), 3,
                 "odometry_noise is -1, it must be 0 or more");
  expect_refusal(nbvopt_run(episode({"--pose-source", "slam", "--lidar-range", "0.13", "--map-out",
                                     folder / "no-map.ot"})),
                 3, "slam: the lidar sees nothing within 0.13 m");
  expect_refusal(nbvopt_run(episode({"--map-out", folder / "no/map.ot"})), 3, "no folder");
  expect_refusal(nbvopt_run(drive({"--start", "0,0.05,0"})), 3, "the start (0, 0.05)");
  expect_refusal(nbvopt_run(drive({"--start", "50,50,0"})), 3, "there is no floor");
  expect_refusal(nbvopt_run(drive({"--start", "0.617,0.713,0", "--goal", "3000,3000"})), 3,
                 "200 m");
  expect_refusal(nbvopt_run(drive({"--start", "0.617,0.713,0", "--goal", "4.75,3"})), 3, "goal");
}

class SimulateWorlds : public Simulate {
 protected:
  /// A world of one model whose visual is this geometry.
  std::string world(const std::string& geometry) const {
    return folder.write("made.world",
                        "<sdf version='1.6'><world name='w'><model name='m'><static>true</static>"
                        "<link name='l'>" +
                            geometry + "</link></model></world></sdf>");
  }

  static ProcessResult run(const std::string& world, const Arguments& more = {}) {
    Arguments arguments{"simulate",
                        world,
                        "--no-cache",
                        "--no-progress",
                        "--explore-only",
                        "--start",
                        "5,5,0,0",
                        "--duration-max",
                        "0.5"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return nbvopt_run(arguments);
  }

  static constexpr const char* kBoxAndMissingMesh =
      "<visual name='b'><geometry><box><size>1 1 1</size></box></geometry></visual>"
      "<visual name='v'><geometry><mesh><uri>model://gone/gone.dae</uri></mesh></geometry>"
      "</visual>";
};

TEST_F(SimulateWorlds, WarnsOfAMissingMeshAndGoesOn) {
  const ProcessResult result = run(world(kBoxAndMissingMesh));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("warning: "));
  EXPECT_THAT(result.err, HasSubstr("model://gone/gone.dae"));
}

TEST_F(SimulateWorlds, RefusesAMissingMeshWhenStrict) {
  expect_refusal(run(world(kBoxAndMissingMesh), {"--strict"}), 3, "model://gone/gone.dae");
}

TEST_F(SimulateWorlds, RefusesAWorldWithoutGeometry) {
  expect_refusal(run(world("")), 3, "made.world");
}

}  // namespace
}  // namespace nbvopt::test
