// Many copies of one model.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::box;
using test::link_with;
using test::WorldFolder;
using testing::HasSubstr;
using testing::IsEmpty;

class PopulationTest : public testing::Test {
 protected:
  std::filesystem::path world_with(const std::string& more) const {
    return folder_.add_world(
        "<population name='crates'><model name='crate'><pose>50 50 50 0 0 0</pose>" +
        link_with(box("0.2 0.2 0.2")) + "</model>" + more + "</population>");
  }

  /// Where the boxes of the population stand, in order.
  std::vector<Eigen::Vector3d> positions(const std::string& more) const {
    const World world = read_world(world_with(more), {.is_strict = true});
    EXPECT_THAT(world.warnings, IsEmpty());
    constexpr std::size_t kBoxVertices = 8;
    std::vector<Eigen::Vector3d> middles;
    for (std::size_t i = 0; i < world.mesh.vertices_m.size(); i += kBoxVertices) {
      const auto first = world.mesh.vertices_m.begin() + static_cast<std::ptrdiff_t>(i);
      middles.push_back(test::middle_of({{first, first + kBoxVertices}, {}}));
    }
    EXPECT_EQ(middles.size(), world.models);
    return middles;
  }

  static std::string distribution(const std::string& type, const std::string& more = "") {
    return "<distribution><type>" + type + "</type>" + more + "</distribution>";
  }

  static bool near(const Eigen::Vector3d& a, double x, double y, double z) {
    return (a - Eigen::Vector3d(x, y, z)).norm() < 2e-4;
  }

  WorldFolder folder_;
};

TEST_F(PopulationTest, StandsInARowAsGazeboPutsIt) {
  const std::string region =
      "<pose>2 0 0 0 0 0</pose><box><size>1 3 0.01</size></box><model_count>3</model_count>";
  const auto along_y = positions(region + distribution("linear-y"));
  ASSERT_EQ(along_y.size(), 3U);
  EXPECT_TRUE(near(along_y[0], 2, -1.5, 0));
  EXPECT_TRUE(near(along_y[1], 2, -0.5, 0));
  EXPECT_TRUE(near(along_y[2], 2, 0.5, 0));
  EXPECT_TRUE(near(positions(region + distribution("linear-x"))[2], 2.0 - 0.5 + 2.0 / 3.0, 0, 0));
  EXPECT_TRUE(
      near(positions(region + distribution("linear-z"))[2], 2, 0, -0.005 + 0.01 * 2.0 / 3.0));
}

TEST_F(PopulationTest, StandsOnAGridAboutItsPose) {
  const auto places =
      positions("<pose>1 2 3 0 0 0</pose>" + distribution("grid",
                                                          "<rows>2</rows><cols>3</cols>"
                                                          "<step>2 4 9</step>"));
  ASSERT_EQ(places.size(), 6U);
  EXPECT_TRUE(near(places[0], -1, 0, 3));
  EXPECT_TRUE(near(places[2], 3, 0, 3));
  EXPECT_TRUE(near(places[5], 3, 4, 3));
}

TEST_F(PopulationTest, StaysInItsRegionAndIsTheSameEveryTime) {
  const std::string in_box = "<pose>5 0 1 0 0 0</pose><box><size>2 4 1</size></box>";
  const std::string in_cylinder =
      "<pose>5 0 1 0 0 0</pose><cylinder><radius>2</radius><length>1</length></cylinder>";
  for (const char* type : {"random", "uniform"}) {
    const std::string many = "<model_count>60</model_count>" + distribution(type);
    const auto boxes = positions(in_box + many);
    ASSERT_EQ(boxes.size(), 60U);
    EXPECT_EQ(boxes, positions(in_box + many));
    for (const Eigen::Vector3d& p : boxes) {
      EXPECT_LE((p - Eigen::Vector3d(5, 0, 1))
                    .cwiseAbs()
                    .cwiseQuotient(Eigen::Vector3d(1, 2, 0.5))
                    .maxCoeff(),
                1.001);
    }
    const auto round = positions(in_cylinder + many);
    ASSERT_EQ(round.size(), 60U);
    for (const Eigen::Vector3d& p : round) {
      EXPECT_LE((p - Eigen::Vector3d(5, 0, 1)).head<2>().norm(), 2.001);
      EXPECT_LE(std::abs(p.z() - 1.0), 0.501);
    }
    // Both sides of the middle are taken.
    EXPECT_LT(std::ranges::min(round, {}, [](const auto& p) { return p.x(); }).x(), 4.0);
    EXPECT_GT(std::ranges::max(round, {}, [](const auto& p) { return p.x(); }).x(), 6.0);
  }
}

TEST_F(PopulationTest, IsLeftOutWithTheReason) {
  const std::string in_box = "<box><size>1 1 1</size></box>";
  const std::pair<std::string, std::string> cases[] = {
      {in_box + distribution("fog"), "its distribution is 'fog'"},
      {distribution("random"), "without a <box> or <cylinder>"},
      {in_box + "<model_count>0</model_count>" + distribution("random"), "<model_count> is 0"},
      {in_box + "<model_count>1e9</model_count>" + distribution("random"),
       "<model_count> is 1e+09"},
      {"<box><size>1 -1 1</size></box>" + distribution("random"), "size is -1"},
      {"<cylinder><radius>0</radius></cylinder>" + distribution("uniform"), "radius is 0"},
      {distribution("grid", "<rows>1000</rows><cols>1000</cols>"), "more than 100000 places"}};
  for (const auto& [more, reason] : cases) {
    EXPECT_THAT(
        test::message_of<InputError>([&] { read_world(world_with(more), {.is_strict = true}); }),
        testing::AllOf(HasSubstr("population 'crates' is left out"), HasSubstr(reason)));
  }
}

}  // namespace
}  // namespace nbvopt
