// What files of Gazebo hold besides what the specification shows first.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::box;
using test::include;
using test::link_with;
using test::message_of;
using test::middle_of;
using test::WorldFolder;
using testing::HasSubstr;
using testing::IsEmpty;

class GazeboConvention : public testing::Test {
 protected:
  /// Where the only box of a world stands, of which nothing is missing.
  Eigen::Vector3d middle(const std::string& body, const std::string& version = "1.6") const {
    const World world = read_world(folder_.add_world(body, version), {.is_strict = true});
    EXPECT_THAT(world.warnings, IsEmpty());
    return middle_of(world.mesh);
  }

  static std::string visual(const std::string& pose) {
    return "<visual name='v'>" + pose + "<geometry>" + box("1 1 1") + "</geometry></visual>";
  }

  WorldFolder folder_;
};

TEST_F(GazeboConvention, FlattenedModelsWithEmptyFrames) {
  const std::string links =
      "<link name='window::pane'><pose frame=''>2 0 0 0 0 0</pose><inertial><pose frame=''>0 0 0 0 "
      "0 0</pose></inertial>" +
      visual("<pose frame=''>0 0 1 0 0 0</pose>") + "</link>";
  EXPECT_EQ(middle("<model name='room'>" + links + "</model>"), Eigen::Vector3d(2, 0, 1));
  EXPECT_EQ(middle("<model name='room'>" + links + "</model>", "1.9"), Eigen::Vector3d(2, 0, 1));
  // A frame may be one of the flattened links.
  EXPECT_EQ(middle("<model name='room'><link name='window::pane'><pose>2 0 0 0 0 0</pose></link>"
                   "<link name='handle'><pose relative_to='window::pane'>0 1 0 0 0 0</pose>" +
                   visual("") + "</link></model>"),
            Eigen::Vector3d(2, 1, 0));
}

TEST_F(GazeboConvention, ValuesOfWhatIsNoGeometryAreNotRead) {
  EXPECT_EQ(middle("<scene><sky><clouds><speed>-4</speed></clouds></sky></scene>"
                   "<physics type='what'><max_step_size>fast</max_step_size></physics>"
                   "<gravity>down</gravity><plugin/><unheard_of x='1'/>"
                   "<light name='sun' type='no'><pose>1 2</pose></light>"
                   "<model name='m'><static>maybe</static><joint name='j' type='no'><axis/></joint>"
                   "<link name='l'><inertial><mass>-1</mass><inertia><ixx>x</ixx></inertia>"
                   "</inertial><sensor name='s' type='?'><pose>1</pose></sensor>"
                   "<collision name='c'><geometry>" +
                   box("no size") + "</geometry></collision>" + visual("") + "</link></model>"),
            Eigen::Vector3d(0, 0, 0));
}

TEST_F(GazeboConvention, PosesOfEveryFormat) {
  const auto at = [&](const std::string& pose) {
    return middle("<model name='m'>" + pose + "<link name='l'>" +
                      visual("<pose>1 0 0 0 0 0</pose>") + "</link></model>",
                  "1.9");
  };
  EXPECT_EQ(at("<pose degrees='true'>0 0 5 0 0 90</pose>"), Eigen::Vector3d(0, 1, 5));
  EXPECT_EQ(at("<pose rotation_format='quat_xyzw'>0 0 5 0 0 0.70710678 0.70710678</pose>"),
            Eigen::Vector3d(0, 1, 5));
  EXPECT_EQ(at("<pose/>"), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(at("<pose>\n  +0 0\t1e0\r\n 0 -0 0 </pose>"), Eigen::Vector3d(1, 0, 1));
}

TEST_F(GazeboConvention, FramesOfPlacementJointsAndOtherModels) {
  const std::string table =
      "<frame name='top'><pose>0 0 2 0 0 0</pose></frame><link name='l'>" + visual("") + "</link>";
  EXPECT_EQ(
      middle("<model name='m' placement_frame='top'><pose>5 0 0 0 0 0</pose>" + table + "</model>",
             "1.8"),
      Eigen::Vector3d(5, 0, -2));
  folder_.add_model("table", table, "1.8");
  EXPECT_EQ(middle(include("model://table",
                           "<placement_frame>top</placement_frame>"
                           "<pose>5 0 0 0 0 0</pose>"),
                   "1.8"),
            Eigen::Vector3d(5, 0, -2));
  EXPECT_EQ(middle("<model name='a'><pose>0 3 0 0 0 0</pose><link name='a'><pose>1 0 0 0 0 0"
                   "</pose></link><joint name='j' type='fixed'><parent>world</parent><child>a"
                   "</child><pose>0 0 7 0 0 0</pose></joint></model>"
                   "<model name='b'><pose relative_to='a::j'>0 1 0 0 0 0</pose><link name='l'>" +
                       visual("") + "</link></model>",
                   "1.9"),
            Eigen::Vector3d(1, 4, 7));
}

TEST_F(GazeboConvention, MergedIncludesLendTheirFrames) {
  folder_.add_model("base", "<link name='plate'><pose>0 0 3 0 0 0</pose></link>", "1.9");
  EXPECT_EQ(middle("<model name='robot'><include merge='true'><uri>model://base</uri></include>"
                   "<link name='mast'><pose relative_to='plate'>1 0 0 0 0 0</pose>" +
                       visual("") + "</link></model>",
                   "1.9"),
            Eigen::Vector3d(1, 0, 3));
}

TEST_F(GazeboConvention, FramesGivenInThemselvesLeaveTheirPartOut) {
  const auto world = folder_.add_world(
      "<model name='m'><frame name='a'><pose relative_to='b'/></frame><frame name='b'>"
      "<pose relative_to='a'/></frame><link name='l'><pose relative_to='a'/>" +
          visual("") + "</link></model>",
      "1.9");
  EXPECT_THAT(message_of<InputError>([&] { read_world(world, {.is_strict = true}); }),
              HasSubstr("link 'l' is left out"));
}

TEST_F(GazeboConvention, RootsOfOlderVersions) {
  const auto path = folder_.add_file("worlds/old.world",
                                     "<?xml version='1.0'?>\n<gazebo version='1.2'><world name='w'>"
                                     "<model name='m'><link name='l'>" +
                                         visual("") + "</link></model></world></gazebo>");
  EXPECT_EQ(read_world(path, {}).mesh.triangles.size(), 12U);
}

TEST_F(GazeboConvention, TheOldestRootIsRefusedNotReadWrongly) {
  const auto path =
      folder_.add_file("worlds/old.world",
                       "<gazebo version='1.0'><world name='w'><model name='m'><origin pose='1 0 "
                       "0 0 0 0'/><link name='l'/></model></world></gazebo>");
  EXPECT_THAT(message_of<InputError>([&] { read_world(path, {}); }),
              HasSubstr("SDF 1.0: convert it"));
}

TEST_F(GazeboConvention, TheNewestOfAModelsFilesCounts) {
  folder_.add_file("models/m/model.config",
                   "<model><name>m</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.10'>"
                   "odd.sdf</sdf><sdf version='1.6'>new.sdf</sdf></model>");
  const auto sdf = [](const char* size) {
    return "<sdf version='1.4'><model name='m'>" + link_with(box(size)) + "</model></sdf>";
  };
  folder_.add_file("models/m/old.sdf", sdf("1 1 1"));
  folder_.add_file("models/m/new.sdf", sdf("2 2 2"));
  const auto size_m = [&] {
    return read_world(folder_.add_world(include("model://m")), {}).bounds_m.sizes().x();
  };
  EXPECT_EQ(size_m(), 2.0);
  folder_.add_file("models/m/odd.sdf", sdf("3 3 3"));
  EXPECT_EQ(size_m(), 3.0);
}

TEST_F(GazeboConvention, ModelsThatAreNoneSaySo) {
  folder_.add_file("models/robot/model.sdf", "<robot name='r'/>");
  folder_.add_file("models/broken/model.sdf", "<sdf><model name='m'>");
  const auto message = [&](const char* name) {
    return message_of<InputError>([&] {
      read_world(folder_.add_world(include(name) + "<model name='m'>" + link_with(box("1 1 1")) +
                                   "</model>"),
                 {.is_strict = true});
    });
  };
  EXPECT_THAT(message("model://robot"), HasSubstr("a URDF: convert it"));
  EXPECT_THAT(message("model://broken"), HasSubstr("model.sdf: Error parsing XML"));
}

TEST_F(GazeboConvention, Cones) {
  const auto path = folder_.add_world(
      "<model name='m'>" +
          link_with("<cone><radius>2</radius><length>3</length></cone>", "0 0 1.5 0 0 0") +
          "</model>",
      "1.11");
  const World world = read_world(path, {.is_strict = true});
  EXPECT_TRUE(test::has_vertex(world.mesh, {0, 0, 3}));
  EXPECT_TRUE(test::has_vertex(world.mesh, {2, 0, 0}));
  EXPECT_TRUE(test::has_vertex(world.mesh, {0, 0, 0}));
}

}  // namespace
}  // namespace nbvopt
