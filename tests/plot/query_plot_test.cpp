#include "plot/query_plot.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "plot/axis.hpp"
#include "plot/canvas.hpp"
#include "plot/style.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(Decimal, HasATrueMinusSignAndNoNegativeZero) {
  EXPECT_EQ(decimal(-1.25, 1), "\u22121.2");
  EXPECT_EQ(decimal(-0.001, 2), "0.00");
  EXPECT_EQ(decimal(3.0, 0), "3");
}

TEST(GainColour, GrowsLighterWithTheGain) {
  double before = -1.0;
  for (double share = 0.0; share <= 1.0; share += 0.01) {
    const Colour colour = style::gain_colour(share);
    const double luma = 0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue;
    EXPECT_GT(luma, before) << share;
    before = luma;
  }
}

TEST(Ticks, AreRoundAndInside) {
  const Ticks ticks = make_ticks(-2.6, 6.4, 9);
  EXPECT_DOUBLE_EQ(ticks.step, 1.0);
  EXPECT_THAT(ticks.values, testing::ElementsAre(-2, -1, 0, 1, 2, 3, 4, 5, 6));
  EXPECT_EQ(ticks.label(-2.0), "\u22122");
}

TEST(Ticks, SayAsManyDigitsAsTheyNeed) {
  const Ticks ticks = make_ticks(0.0, 0.2, 8);
  EXPECT_DOUBLE_EQ(ticks.step, 0.05);
  EXPECT_EQ(ticks.label(0.15), "0.15");
}

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

TEST(LogTicks, AreDecades) {
  const std::vector<Tick> ticks = make_log_ticks(0.01, 20'000.0);
  EXPECT_THAT(labels(ticks),
              testing::ElementsAre("0.01", "0.1", "1", "10", "100", "1,000", "10,000"));
  EXPECT_DOUBLE_EQ(ticks.front().value, 0.01) << "the ends included";
}

TEST(LogTicks, AreCloserWithinADecade) {
  EXPECT_THAT(labels(make_log_ticks(0.3, 6.0)), testing::ElementsAre("0.5", "1", "2", "5"));
}

/// A robot that stays where it is, in a map of nothing or of one occupied voxel.
class Plot : public testing::Test {
 protected:
  Plot() { request_.joints = {.pan_rad = 0.0, .tilt_rad = 0.0, .height_m = 0.4}; }

  void write(const UncertaintyMap& map, const std::filesystem::path& path) {
    const ViewPlanner planner(VoxelGrid::whole(map), Robot{});
    result_.request = request_;
    result_.joints = request_.joints;
    result_.T_map_sensor = T_map_sensor(request_, planner.mast(), request_.joints);
    result_.view = result_.current = planner.evaluate(result_.T_map_sensor);
    result_.move_time_s = 0.0;
    const Landscape landscape = planner.landscape(result_);
    write_plot({planner, result_, landscape, {-0.5, 0.5}}, path);
  }

  std::string written() const {
    std::ostringstream bytes;
    bytes << std::ifstream(path_, std::ios::binary).rdbuf();
    return bytes.str();
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "plot.png";
  PlanRequest request_;
  PlanResult result_;
};

TEST_F(Plot, IsAPngFile) {
  result_.box = {{-1.0, -0.5, 0.2}, {1.0, 0.5, 0.6}};
  write(UncertaintyMap(0.1), path_);
  EXPECT_THAT(written(), StartsWith("\x89PNG\r\n\x1a\n"));
}

TEST_F(Plot, ShowsTheMap) {
  result_.box = {{-1.0, -0.5, 0.2}, {1.0, 0.5, 0.6}};
  UncertaintyMap map(0.1);
  write(map, path_);
  const std::string empty = written();
  // Behind the robot, where no reachable view sees it: only the map can differ.
  map.set(map.lattice().key({-2.05, 0.05, 0.45}),
          {.state = VoxelState::occupied, .log_odds = 3.5F});
  map.finish_writing();
  write(map, path_);
  EXPECT_NE(written(), empty);
}

TEST_F(Plot, ShowsTheSearch) {
  result_.box = {{-1.0, -0.5, 0.2}, {1.0, 0.5, 0.6}};
  write(UncertaintyMap(0.1), path_);
  const std::string without = written();
  result_.trace = {{EvaluationKind::surrogate, {0.6, 0.3, 0.4}, 5.0}};
  write(UncertaintyMap(0.1), path_);
  EXPECT_NE(written(), without);
}

TEST_F(Plot, ShowsWhereAMovingBaseArrives) {
  result_.box = {{-1.0, -0.5, 0.2}, {1.0, 0.5, 0.6}};
  request_.base_twist = {0.2, 0.0, 0.0};
  write(UncertaintyMap(0.1), path_);
  const std::string here = written();
  result_.T_map_base = base_pose(-1.0, 0.0, 0.0, 0.0);
  write(UncertaintyMap(0.1), path_);
  EXPECT_NE(written(), here);
}

TEST_F(Plot, DrawsAPanThatCannotMove) {
  result_.box = {request_.joints.vector(), request_.joints.vector()};
  write(UncertaintyMap(0.1), path_);
  EXPECT_THAT(written(), StartsWith("\x89PNG"));
}

TEST_F(Plot, RefusesAFolderThatIsMissing) {
  result_.box = {request_.joints.vector(), request_.joints.vector()};
  try {
    write(UncertaintyMap(0.1), "/no/such/folder/plot.png");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/no/such/folder"));
  }
}

}  // namespace
}  // namespace nbvopt
