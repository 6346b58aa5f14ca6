// Worlds that are kept: the same to the bit, and built again when anything changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/text_file.hpp"
#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

namespace fs = std::filesystem;

using test::box;
using test::has_vertex;
using test::include;
using test::link_with;
using test::mesh;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A world of one mesh in a model and a shape that is left out, read with a cache.
class WorldCacheTest : public testing::Test {
 protected:
  WorldCacheTest()
      : model_(folder_.add_model("m", link_with(mesh("model://m/t.stl")))),
        mesh_(folder_.add_file("models/m/t.stl", test::triangle_stl())),
        world_(folder_.add_world(include("model://m") + "<model name='p'>" +
                                 link_with("<image><height>1</height></image>") + "</model>")) {}

  World read(WorldOptions options = {}) const {
    options.cache_folder = cache();
    return read_world(world_, options);
  }

  fs::path cache() const { return folder_.path() / "cache" / "worlds"; }

  std::vector<fs::path> kept() const {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(cache(), ignored)) files.push_back(entry);
    return files;
  }

  /// The only kept world, with a mark in it: if the world is read from it, a vertex is at z = 7.
  void mark_kept_world() const {
    ASSERT_EQ(kept().size(), 1U);
    fs::remove_all(cache());
    const std::string before = read_text_file(mesh_);
    const auto time = fs::last_write_time(mesh_);
    std::string other = before;
    for (std::size_t at = 0; (at = other.find(" 3\n", at)) != std::string::npos;)
      other[at + 1] = '7';
    rewrite(mesh_, other, time);
    read();
    rewrite(mesh_, before, time);
  }

  static void rewrite(const fs::path& file, const std::string& content, fs::file_time_type time) {
    std::ofstream(file, std::ios::binary) << content;
    fs::last_write_time(file, time);
  }

  bool is_from_cache() const { return has_vertex(read().mesh, {1, 0, 7}); }

  test::WorldFolder folder_;
  fs::path model_;
  fs::path mesh_;
  fs::path world_;
};

TEST_F(WorldCacheTest, GivesTheSameWorldToTheBit) {
  const World built = read();
  ASSERT_EQ(kept().size(), 1U);
  const World kept = read();
  EXPECT_EQ(kept.mesh.vertices_m, built.mesh.vertices_m);
  EXPECT_EQ(kept.mesh.triangles, built.mesh.triangles);
  EXPECT_EQ(kept.bounds_m.min(), built.bounds_m.min());
  EXPECT_EQ(kept.bounds_m.max(), built.bounds_m.max());
  EXPECT_EQ(kept.models, built.models);
  EXPECT_EQ(kept.nested_models, built.nested_models);
  EXPECT_EQ(kept.warnings, built.warnings);
  EXPECT_THAT(kept.warnings, ElementsAre(HasSubstr("'image' is left out")));
}

TEST_F(WorldCacheTest, ReadsTheKeptWorldAndNotTheFiles) {
  read();
  mark_kept_world();
  EXPECT_TRUE(is_from_cache());
}

TEST_F(WorldCacheTest, BuildsAgainWhenAnyOfItsFilesIsTouched) {
  for (const fs::path& file : {world_, mesh_, model_ / "model.sdf", model_ / "model.config"}) {
    read();
    mark_kept_world();
    ASSERT_TRUE(is_from_cache());
    fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(1));
    EXPECT_FALSE(is_from_cache()) << file;
  }
}

TEST_F(WorldCacheTest, ReplacesDamagedFiles) {
  read();
  const std::string whole = read_text_file(kept().at(0));
  std::vector<std::string> damaged{"", "nbv", whole.substr(0, whole.size() / 2), whole + "more"};
  for (std::size_t at = 0; at < whole.size(); at += 61) {
    damaged.push_back(whole);
    damaged.back()[at] = static_cast<char>(damaged.back()[at] ^ 0x10);
  }
  for (const std::string& bytes : damaged) {
    std::ofstream(kept().at(0), std::ios::binary) << bytes;
    const World world = read();
    EXPECT_TRUE(has_vertex(world.mesh, {1, 0, 3}));
    EXPECT_EQ(world.warnings.size(), 1U);
    EXPECT_EQ(read_text_file(kept().at(0)), whole);
  }
}

TEST_F(WorldCacheTest, KeepsWorldsOfDifferentOptionsApart) {
  read();
  EXPECT_THAT(test::message_of<InputError>([&] { read({.geometry = WorldGeometry::collision}); }),
              HasSubstr("there is no geometry"));
  EXPECT_TRUE(has_vertex(read().mesh, {1, 0, 3}));
}

TEST_F(WorldCacheTest, IsAsStrictOverKeptWorlds) {
  read();
  ASSERT_EQ(kept().size(), 1U);
  EXPECT_THAT(test::message_of<InputError>([&] { read({.is_strict = true}); }),
              HasSubstr("'image' is left out"));
}

TEST_F(WorldCacheTest, SeesAMissingMeshAppear) {
  fs::remove(mesh_);
  folder_.add_model("m", link_with(mesh("model://m/t.stl")) +
                             "<link name='b'><visual name='b'><geometry>" + box("1 1 1") +
                             "</geometry></visual></link>");
  EXPECT_EQ(read().mesh.triangles.size(), 12U);
  folder_.add_file("models/m/t.stl", test::triangle_stl());
  EXPECT_EQ(read().mesh.triangles.size(), 13U);
}

TEST_F(WorldCacheTest, WarnsWhenTheFolderCannotBeUsed) {
  folder_.add_file("cache", "a file where the folder should be");
  const World world = read();
  EXPECT_TRUE(has_vertex(world.mesh, {1, 0, 3}));
  ASSERT_EQ(world.warnings.size(), 2U);
  EXPECT_THAT(world.warnings.at(1), HasSubstr("the world is not kept: "));
}

}  // namespace
}  // namespace nbvopt
