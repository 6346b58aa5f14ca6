// What URIs of worlds name, and where that is looked for.
#include "sim/world/model_uri.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

using test::box;
using test::include;
using test::link_with;
using test::mesh;
using test::message_of;
using test::WorldFolder;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(ModelUri, TakesAddressesOfFuelApart) {
  const auto whole = fuel_address(
      "https://fuel.gazebosim.org/1.0/Some Body/models/Flat%20Ground/3/files/meshes/a%2fb.dae");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->host, "fuel.gazebosim.org");
  EXPECT_EQ(whole->owner, "Some Body");
  EXPECT_EQ(whole->name, "Flat Ground");
  EXPECT_EQ(whole->version, "3");
  EXPECT_EQ(whole->rest, fs::path("meshes/a/b.dae"));
  for (const char* newest :
       {"https://h/1.0/o/models/m", "https://h/o/models/m/tip/files", "http://h/1.0/o/models/m/"}) {
    const auto address = fuel_address(newest);
    ASSERT_TRUE(address) << newest;
    EXPECT_EQ(address->name, "m");
    EXPECT_EQ(address->version, "");
    EXPECT_TRUE(address->rest.empty() || address->rest == "") << address->rest;
  }
  for (const char* none :
       {"model://a/models/m", "https://h/models", "https://h/1.0/o/worlds/w", "https://", ""}) {
    EXPECT_FALSE(fuel_address(none)) << none;
  }
}

TEST(ModelUri, KnowsWhereAUriMayLead) {
  EXPECT_THAT(paths_below("package://pkg/models/a/b.dae"),
              ElementsAre("pkg/models/a/b.dae", "models/a/b.dae", "models/a/b.dae", "a/b.dae"));
  EXPECT_THAT(paths_below("file://models/a/b.dae"),
              ElementsAre("models/a/b.dae", "models/a/b.dae", "a/b.dae"));
  EXPECT_THAT(paths_below("model:///a"), ElementsAre("a"));
  EXPECT_THAT(paths_below("https://h/1.0/o/models/m/2/files/x.dae"), ElementsAre("m/x.dae"));
}

/// A package in which worlds, models and meshes lie as in AWS RoboMaker's, and a world elsewhere.
class ModelSearch : public testing::Test {
 protected:
  ModelSearch() {
    package_.add_model("Crate", link_with(mesh("file://models/Crate/meshes/t.stl")));
    package_.add_file("models/Crate/meshes/t.stl", test::triangle_stl());
  }

  static void expect_found(const fs::path& world, const std::vector<fs::path>& model_paths) {
    const World read = read_world(world, {.model_paths = model_paths, .is_strict = true});
    EXPECT_EQ(read.mesh.triangles.size(), 1U);
    EXPECT_THAT(read.warnings, IsEmpty());
  }

  WorldFolder package_;
  WorldFolder elsewhere_;
};

TEST_F(ModelSearch, FindsMeshesFromTheModelsFolderOn) {
  expect_found(package_.add_world(include("model://Crate")), {});
  const fs::path world = elsewhere_.add_world(include("model://Crate"));
  for (const char* given : {".", "models", "models/Crate"}) {
    expect_found(world, {package_.path() / given});
  }
}

TEST_F(ModelSearch, FindsPackagesByAnyFolderOfThem) {
  const std::string name = package_.path().filename().string();
  const fs::path world = elsewhere_.add_world(
      "<model name='m'>" + link_with(mesh("package://" + name + "/models/Crate/meshes/t.stl")) +
      "</model>");
  for (const char* given : {"..", ".", "models"}) expect_found(world, {package_.path() / given});
}

TEST_F(ModelSearch, AdviceOfWarningsWorksWhenFollowed) {
  const fs::path world = elsewhere_.add_world(
      "<model name='m'>" + link_with(mesh("file://models/Crate/meshes/t.stl")) + "</model>");
  EXPECT_THAT(message_of<InputError>([&] { read_world(world, {.is_strict = true}); }),
              AllOf(HasSubstr("'file://models/Crate/meshes/t.stl' is not found"),
                    HasSubstr("give the folder of its model as a model path")));
  expect_found(world, {package_.path() / "models" / "Crate"});
}

class FuelSearch : public testing::Test {
 protected:
  FuelSearch() { setenv("GZ_FUEL_CACHE_PATH", (cache_.path() / "fuel").c_str(), 1); }
  ~FuelSearch() override { unsetenv("GZ_FUEL_CACHE_PATH"); }

  static std::string model_sdf(const std::string& size) {
    return "<sdf version='1.6'><model name='m'>" + link_with(box(size)) + "</model></sdf>";
  }

  static double size_m(const fs::path& world, const WorldOptions& options = {}) {
    return read_world(world, options).bounds_m.sizes().x();
  }

  WorldFolder cache_;
  WorldFolder folder_;
};

TEST_F(FuelSearch, TakesAnAddressForTheNameOfAModel) {
  folder_.add_model("flat ground", link_with(box("2 2 2")));
  folder_.add_file("models/flat ground/meshes/t.stl", test::triangle_stl());
  const std::string address = "https://fuel.gazebosim.org/1.0/Somebody/models/Flat Ground";
  for (const char* more : {"", "/2", "/tip", "/tip/files"}) {
    EXPECT_EQ(size_m(folder_.add_world(include(address + more))), 2.0) << more;
  }
  EXPECT_EQ(
      read_world(folder_.add_world("<model name='m'>" +
                                   link_with(mesh(address + "/2/files/meshes/t.stl")) + "</model>"),
                 {.is_strict = true})
          .mesh.triangles.size(),
      1U);
}

TEST_F(FuelSearch, LooksIntoTheLocalCache) {
  const std::string in_cache = "fuel/fuel.ignitionrobotics.org/somebody/models/table/";
  cache_.add_file(in_cache + "2/model.sdf", model_sdf("2 1 1"));
  cache_.add_file(in_cache + "10/model.sdf", model_sdf("3 1 1"));
  const std::string address = "https://fuel.gazebosim.org/1.0/Somebody/models/Table";
  EXPECT_EQ(size_m(folder_.add_world(include(address))), 3.0);
  EXPECT_EQ(size_m(folder_.add_world(include(address + "/2"))), 2.0);
  folder_.add_model("table", link_with(box("5 5 5")));  // the user's own goes first
  EXPECT_EQ(size_m(folder_.add_world(include(address))), 5.0);
}

TEST_F(FuelSearch, SaysHowToHaveAModelThatIsNotHere) {
  const auto world = folder_.add_world(include("https://fuel.gazebosim.org/1.0/o/models/Absent"));
  EXPECT_THAT(message_of<InputError>([&] { read_world(world, {}); }),
              AllOf(HasSubstr("models/Absent' is not found"), HasSubstr("gz fuel download")));
}

TEST_F(FuelSearch, StandsInForTheFloorAndTheSunOfGazebo) {
  const std::string fuel = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/";
  for (const std::string& ground : {std::string("model://ground_plane"), fuel + "Ground Plane"}) {
    for (const std::string& sun : {std::string("model://sun"), fuel + "Sun"}) {
      const World world =
          read_world(folder_.add_world(include(sun) + include(ground, "<pose>0 0 -1 0 0 0</pose>")),
                     {.is_strict = true});
      EXPECT_TRUE(test::has_vertex(world.mesh, {50, 50, -1}));
      EXPECT_THAT(world.warnings, ElementsAre(HasSubstr("a plane of 100 m")));
    }
  }
}

}  // namespace
}  // namespace nbvopt
