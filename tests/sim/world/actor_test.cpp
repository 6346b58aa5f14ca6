// Actors of worlds: people as read, and what is left out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/people/cafe_people.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"
#include "support/paths.hpp"

namespace nbvopt::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A floor with an actor.
std::string floor_and(const std::string& actor) {
  return "<model name='floor'>" + link_with(box("9 9 0.1")) + "</model>" + actor;
}

People people_in(const std::string& body) {
  const WorldFolder folder;
  const World world = read_world(folder.add_world(floor_and(body)), {});
  EXPECT_THAT(world.warnings, IsEmpty());
  return world.people;
}

TEST(Actors, WalkAlongTheWaypointsOfTheirScript) {
  const People people = people_in(
      "<actor name='a'><pose>1 2 0.5 0 0 0.3</pose><skin><filename>none.dae</filename></skin>"
      "<script><loop>false</loop><delay_start>1.5</delay_start><auto_start>0</auto_start>"
      "<trajectory id='1'><waypoint><time>4</time><pose>7 0 1 0 0 0</pose></waypoint></trajectory>"
      "<trajectory id='0'><waypoint><time>2</time><pose>3 0 1 0 0 1</pose></waypoint>"
      "<waypoint><time>0.5</time><pose>0 0 1 0 0 0</pose></waypoint></trajectory></script>"
      "<plugin name='p' filename='libOther.so'/></actor>");
  ASSERT_EQ(people.persons.size(), 1U);
  EXPECT_EQ(people.persons[0].name, "a");
  EXPECT_EQ(people.persons[0].position_map_m, Eigen::Vector3d(1.0, 2.0, 0.5));
  EXPECT_DOUBLE_EQ(people.persons[0].yaw_rad, 0.3);
  const auto& walk = std::get<ScriptedWalk>(people.persons[0].walk);
  EXPECT_FALSE(walk.is_loop);
  EXPECT_EQ(walk.delay_s, 1.5);
  EXPECT_FALSE(walk.starts_itself);
  // The first waypoint is passed at once; the second trajectory begins where the first one ends.
  EXPECT_THAT(walk.waypoints,
              ElementsAre(Waypoint{0.0, {0, 0, 1}, 0.0}, Waypoint{2.0, {7, 0, 1}, 0.0}));
}

TEST(Actors, StandWhereNothingSaysThatTheyWalk) {
  const People people = people_in("<actor name='a'><pose>1 2 0.5 0 0 0</pose></actor>");
  ASSERT_EQ(people.persons.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(people.persons[0].walk));
  EXPECT_THAT(people.models, ElementsAre(ModelPlace{"floor", {0.0, 0.0, 0.0}}));
  EXPECT_EQ(people_in(""), People());
}

TEST(Actors, TakeWhatTheirPluginIsToldAndItsOwnValues) {
  const People people = people_in(
      "<actor name='a'><plugin name='p' filename='libActorPlugin.so'><target>1 2 3</target>"
      "<ignore_obstacles><model>x</model><model>y</model></ignore_obstacles></plugin></actor>");
  ASSERT_EQ(people.persons.size(), 1U);
  EXPECT_EQ(std::get<TargetWalk>(people.persons[0].walk),
            (TargetWalk{.target_map_m = {1.0, 2.0, 3.0},
                        .target_weight = 1.15,
                        .obstacle_weight = 1.5,
                        .ignored_models = {"x", "y"}}));
}

TEST(Actors, AreLeftOutWithTheReason) {
  const std::string waypoint = "<waypoint><time>0</time><pose>0 0 0 0 0 0</pose></waypoint>";
  const auto scripted = [](const std::string& body) {
    return "<actor name='a'><script>" + body + "</script></actor>";
  };
  const std::pair<std::string, std::string> cases[] = {
      {"<actor name='a'><pose>0 0 x 0 0 0</pose></actor>",
       "<pose> is '0 0 x 0 0 0', it must be 6 numbers"},
      {scripted("<trajectory id='0'/>"), "<trajectory> has no <waypoint>"},
      {scripted("<trajectory><waypoint><time>0</time><pose>0 0 nan 0 0 0</pose></waypoint>"
                "</trajectory>"),
       "<pose> is '0 0 nan 0 0 0', it must be 6 numbers"},
      {scripted("<trajectory><waypoint><pose>0 0 0 0 0 0</pose></waypoint></trajectory>"),
       "<waypoint> must have a <time> and a <pose>"},
      {scripted("<trajectory><waypoint><time>-1</time><pose>0 0 0 0 0 0</pose></waypoint>"
                "</trajectory>"),
       "<time> is '-1', it must be 0 or more"},
      {scripted("<loop>often</loop><trajectory>" + waypoint + "</trajectory>"),
       "<loop> is 'often', it must be true or false"},
      {"<actor name='a'><plugin name='p' filename='libDance.so'/></actor>",
       "<plugin> 'libDance.so' is not known: give libActorPlugin.so, or a <script>"},
      {"<actor name='a'><plugin name='p' filename='libActorPlugin.so'><target>1 2</target>"
       "</plugin></actor>",
       "<target> is '1 2', it must be 3 numbers"},
      {"<actor name='floor'/>", "actor 'floor' is left out: one with this name already exists"}};
  for (const auto& [actor, reason] : cases) {
    const WorldFolder folder;
    const auto path = folder.add_world(floor_and(actor));
    const World world = read_world(path, {});
    EXPECT_EQ(world.people, People()) << actor;
    EXPECT_THAT(world.missing, ElementsAre(AllOf(HasSubstr("is left out"), HasSubstr(reason))));
    EXPECT_THAT(message_of<InputError>([&] { read_world(path, {.is_strict = true}); }),
                HasSubstr(reason));
  }
}

TEST(Actors, AreKeptInTheCache) {
  const WorldFolder folder;
  const auto path = folder.add_world(floor_and(
      "<actor name='a'><script><trajectory><waypoint><time>0.1</time><pose>0.1 0 0 0 0 0.7</pose>"
      "</waypoint></trajectory></script></actor><actor name='b'><plugin name='p' "
      "filename='libActorPlugin.so'/></actor><actor name='c'/>"));
  const WorldOptions options{.cache_folder = folder.path() / "cache"};
  const People built = read_world(path, options).people;
  EXPECT_EQ(built.persons.size(), 3U);
  EXPECT_FALSE(std::filesystem::is_empty(folder.path() / "cache"));
  EXPECT_EQ(read_world(path, options).people, built);
}

TEST(Actors, AreThoseOfTheCafe) {
  const std::filesystem::path file = shared_dir() / "worlds/cafe/worlds/cafe.world";
  if (!std::filesystem::exists(file)) {
    GTEST_SKIP() << "the worlds of ../shared are not here, so this was not tested";
  }
  EXPECT_EQ(read_world(file, {}).people, cafe_people());
  EXPECT_EQ(read_world(file.parent_path() / "cafe_static_closed.world", {}).people, People());
}

}  // namespace
}  // namespace nbvopt::test
