// Where models and kept worlds of this user lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "nbvopt/sim/world.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

namespace fs = std::filesystem;

class UserFolders : public testing::Test {
 protected:
  void TearDown() override {
    if (!home_.empty()) setenv("HOME", home_.c_str(), 1);
  }

 private:
  std::string home_ = std::getenv("HOME") == nullptr ? "" : std::getenv("HOME");
};

TEST_F(UserFolders, ModelsLieWhereGazeboLooks) {
  const test::TemporaryFolder home;
  const fs::path a = home.path() / "a";
  const fs::path b = home.path() / "b";
  const fs::path own = home.path() / ".gazebo" / "models";
  for (const fs::path& folder : {a, b, own}) fs::create_directories(folder);
  setenv("HOME", home.path().c_str(), 1);
  setenv("GAZEBO_MODEL_PATH", (":" + a.string() + "::/not/there:").c_str(), 1);
  setenv("GZ_SIM_RESOURCE_PATH", (b.string() + ":" + a.string()).c_str(), 1);
  EXPECT_THAT(gazebo_model_paths(), ElementsAre(a, b, own));
  unsetenv("GAZEBO_MODEL_PATH");
  unsetenv("GZ_SIM_RESOURCE_PATH");
  EXPECT_THAT(gazebo_model_paths(), ElementsAre(own));
  fs::remove_all(own);
  EXPECT_THAT(gazebo_model_paths(), IsEmpty());
}

TEST_F(UserFolders, WorldsAreKeptInTheCacheOfTheUser) {
  setenv("HOME", "/home/ada", 1);
  setenv("XDG_CACHE_HOME", "/cache", 1);
  EXPECT_EQ(user_cache_folder(), fs::path("/cache/nbvopt"));
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(user_cache_folder(), fs::path("/home/ada/.cache/nbvopt"));
  unsetenv("HOME");
  EXPECT_EQ(user_cache_folder(), std::nullopt);
}

}  // namespace
}  // namespace nbvopt
