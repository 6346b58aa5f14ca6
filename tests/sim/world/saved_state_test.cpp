// Worlds as Gazebo saved them after they had run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"

namespace nbvopt {
namespace {

using test::box;
using test::box_of;
using test::link_with;
using test::middle_of;
using test::WorldFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class SavedState : public testing::Test {
 protected:
  /// A world of these models in which a state was saved, complete.
  World read(const std::string& models, const std::string& state) const {
    World world = read_world(
        folder_.add_world(models + "<state world_name='test'>" + state + "</state>"), {});
    EXPECT_THAT(world.warnings, IsEmpty());
    return world;
  }

  static std::string model(const std::string& name, const std::string& body) {
    return "<model name='" + name + "'>" + body + "</model>";
  }

  WorldFolder folder_;
};

TEST_F(SavedState, PutsModelsWhereTheyStood) {
  const World world = read(model("crate", "<pose>2 0 0 0 0 0</pose>" + link_with(box("1 1 1"))),
                           model("crate", "<pose>0 -3 0.5 0 0 1.5707963267948966</pose>") +
                               model("gone_since", "<pose>9 9 9 0 0 0</pose>"));
  EXPECT_EQ(middle_of(world.mesh), Eigen::Vector3d(0, -3, 0.5));
  EXPECT_EQ(world.models, 1U);
}

TEST_F(SavedState, GivesLinksInTheMapWhateverTheyAreIn) {
  const World world = read(
      model("door", "<pose>5 0 0 0 0 0</pose><link name='still'><pose>1 0 0 0 0 0</pose></link>" +
                        link_with(box("1 1 1"))),
      model("door", "<pose>6 0 0 0 0 0</pose><link name='link'><pose>-1 2 0 0 0 0</pose></link>"));
  EXPECT_EQ(middle_of(world.mesh), Eigen::Vector3d(-1, 2, 0));
}

TEST_F(SavedState, ReachesModelsInModels) {
  const std::string inner = model("inner", "<pose>0 1 0 0 0 0</pose>" + link_with(box("1 1 1")));
  EXPECT_EQ(middle_of(read(model("outer", inner), model("outer", "<pose>7 0 0 0 0 0</pose>")).mesh),
            Eigen::Vector3d(7, 1, 0));
  EXPECT_EQ(middle_of(read(model("outer", inner),
                           model("outer", "<pose>7 0 0 0 0 0</pose>" +
                                              model("inner", "<pose>0 0 4 0 0 0</pose>")))
                          .mesh),
            Eigen::Vector3d(0, 0, 4));
}

TEST_F(SavedState, StretchesShapesAboutTheirOwnOriginAndKeepsRoundOnesRound) {
  const auto size = [&](const std::string& shape) -> Eigen::Vector3d {
    const World world = read(model("m", link_with(shape, "1 0 0 0 0 0")),
                             model("m", "<pose>0 0 0 0 0 0</pose><scale>2 3 4</scale>"));
    EXPECT_EQ(middle_of(world.mesh), Eigen::Vector3d(1, 0, 0)) << shape;
    return box_of(world.mesh).sizes();
  };
  EXPECT_TRUE(size(box("1 1 1")).isApprox(Eigen::Vector3d(2, 3, 4), 1e-6));
  EXPECT_TRUE(size("<sphere><radius>1</radius></sphere>").isApprox(Eigen::Vector3d(8, 8, 8), 1e-6));
  EXPECT_TRUE(size("<cylinder><radius>1</radius><length>1</length></cylinder>")
                  .isApprox(Eigen::Vector3d(6, 6, 4), 1e-6));
}

TEST_F(SavedState, AddsInsertionsAndRemovesDeletions) {
  const World world =
      read(model("kept", link_with(box("1 1 1"))) + model("deleted", link_with(box("50 50 50"))),
           "<insertions>" + model("new", "<pose>3 0 0 0 0 0</pose>" + link_with(box("1 1 1"))) +
               "</insertions><deletions><name>deleted</name></deletions>" +
               model("new", "<pose>4 0 0 0 0 0</pose>"));
  EXPECT_EQ(world.models, 2U);
  EXPECT_TRUE(box_of(world.mesh).min().isApprox(Eigen::Vector3d(-0.5, -0.5, -0.5)));
  EXPECT_TRUE(box_of(world.mesh).max().isApprox(Eigen::Vector3d(4.5, 0.5, 0.5)));
}

TEST_F(SavedState, DoesNotRoundWhatDidNotMove) {
  const std::string declared = "1.00000491 0 0 0 0 0";
  const World world = read(model("m", "<pose>" + declared + "</pose>" + link_with(box("2 2 2"))),
                           model("m", "<pose>1.00001 0 0 0 0 0</pose>"));
  EXPECT_FLOAT_EQ(static_cast<float>(box_of(world.mesh).max().x()), 2.00000491F);
}

TEST_F(SavedState, CountsTheFirstOfSeveral) {
  const std::string crate = model("crate", link_with(box("1 1 1")));
  const auto state = [&](const char* x) {
    return "<state world_name='test'>" +
           model("crate", "<pose>" + std::string(x) + " 0 0 0 0 0</pose>") + "</state>";
  };
  const World world = read_world(folder_.add_world(crate + state("3") + state("8")), {});
  EXPECT_EQ(middle_of(world.mesh), Eigen::Vector3d(3, 0, 0));
}

TEST_F(SavedState, SaysWhichValueCannotBeRead) {
  const World world =
      read_world(folder_.add_world(model("crate", link_with(box("1 1 1"))) + "<state>" +
                                   model("crate", "<pose>3 0</pose>") + "</state>"),
                 {});
  EXPECT_THAT(world.warnings, ElementsAre(HasSubstr("<pose> is '3 0'")));
}

}  // namespace
}  // namespace nbvopt
