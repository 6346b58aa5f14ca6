// Terrain from pictures.
#include "sim/world/heightmap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "nbvopt/core/error.hpp"
#include "nbvopt/sim/world.hpp"
#include "sim/world/world_files.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

using test::has_vertex;
using test::message_of;
using test::WorldFolder;
using testing::AllOf;
using testing::HasSubstr;

/// Writes pixels, from the top left, of as many channels as the format has.
void write_png(const std::filesystem::path& file, std::uint32_t width, std::uint32_t format,
               const std::vector<std::uint8_t>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = format;
  image.width = width;
  image.height =
      static_cast<std::uint32_t>(pixels.size()) / (width * PNG_IMAGE_PIXEL_CHANNELS(format));
  if (png_image_write_to_file(&image, file.c_str(), 0, pixels.data(), 0, nullptr) == 0) {
    throw std::runtime_error("no picture for the test");
  }
}

class Heightmap : public testing::Test {
 protected:
  WorldFolder folder_;
  std::filesystem::path file_ = folder_.add_file("media/terrain.png", "");
};

TEST_F(Heightmap, RisesFromBlackToTheBrightestWithTheTopRowInTheNorth) {
  write_png(file_, 3, PNG_FORMAT_GRAY, {0, 0, 100, 0, 50, 0});
  const TriangleMesh mesh = heightmap_mesh(file_, {20, 10, 4});
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_TRUE(has_vertex(mesh, {-10, 5, 0}));
  EXPECT_TRUE(has_vertex(mesh, {10, 5, 4}));
  EXPECT_TRUE(has_vertex(mesh, {0, -5, 2}));
  EXPECT_TRUE(has_vertex(heightmap_mesh(file_, {20, 10, -4}), {10, 5, 0}));
}

TEST_F(Heightmap, TakesTheFirstChannelOfColours) {
  write_png(file_, 2, PNG_FORMAT_RGBA, {0, 9, 9, 255, 200, 0, 0, 255, 100, 9, 9, 0, 0, 9, 9, 255});
  const TriangleMesh mesh = heightmap_mesh(file_, {2, 2, 2});
  EXPECT_TRUE(has_vertex(mesh, {1, 1, 2}));
  EXPECT_TRUE(has_vertex(mesh, {-1, -1, 1}));
}

TEST_F(Heightmap, SamplesLargePicturesDown) {
  write_png(file_, 1300, PNG_FORMAT_GRAY, std::vector<std::uint8_t>(1300 * 2, 7));
  const TriangleMesh mesh = heightmap_mesh(file_, {13, 1, 1});
  EXPECT_EQ(mesh.triangles.size(), 2U * 1024U);
  EXPECT_TRUE(has_vertex(mesh, {-6.5, 0.5, 1}));
  EXPECT_TRUE(has_vertex(mesh, {6.5, -0.5, 1}));
}

TEST_F(Heightmap, StandsInItsWorld) {
  write_png(file_, 2, PNG_FORMAT_GRAY, {0, 0, 0, 255});
  const auto path = folder_.add_world(
      "<model name='hill'><pose>100 0 0 0 0 0</pose>" +
      test::link_with("<heightmap><uri>file://media/terrain.png</uri><size>8 8 3</size>"
                      "<pos>0 0 -1</pos></heightmap>") +
      "</model>");
  const World world = read_world(path, {.is_strict = true});
  EXPECT_TRUE(has_vertex(world.mesh, {104, -4, 2}));
  EXPECT_TRUE(has_vertex(world.mesh, {96, 4, -1}));
}

TEST_F(Heightmap, IsLeftOutWithTheReason) {
  const auto path = folder_.add_world(
      "<model name='hill'>" +
      test::link_with("<heightmap><uri>../media/terrain.png</uri></heightmap>") + "</model>");
  const auto message = [&] {
    return message_of<InputError>([&] { read_world(path, {.is_strict = true}); });
  };
  folder_.add_file("media/terrain.png", "II*\0 a GeoTIFF");
  EXPECT_THAT(message(), AllOf(HasSubstr("model 'hill'"), HasSubstr("must be a PNG, convert it")));
  folder_.add_file("media/terrain.png", "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(message(), HasSubstr("the PNG cannot be read: it is truncated"));
  write_png(file_, 1, PNG_FORMAT_GRAY, {1, 2, 3});
  EXPECT_THAT(message(), HasSubstr("2 x 2 pixels or more"));
  std::filesystem::remove(file_);
  EXPECT_THAT(message(), AllOf(HasSubstr("heightmap '../media/terrain.png' is not found"),
                               HasSubstr("model path")));
}

}  // namespace
}  // namespace nbvopt
