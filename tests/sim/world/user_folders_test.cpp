// Where models and kept worlds of this user lie.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "nbvopt/sim/world.hpp"

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
  setenv("GAZEBO_MODEL_PATH", ":/a/models::/b:", 1);
  EXPECT_THAT(gazebo_model_paths(), ElementsAre(fs::path("/a/models"), fs::path("/b")));
  unsetenv("GAZEBO_MODEL_PATH");
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
