#include "nbvopt/map/floor_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <iterator>
#include <string>

#include "nbvopt/core/error.hpp"
#include "nbvopt/map/map_file.hpp"
#include "support/error_message.hpp"
#include "support/temporary_folder.hpp"

namespace nbvopt {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

std::string bytes_in(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Voxels of half a metre relative to the lattice's middle; what is not named is unknown.
void set_voxel(UncertaintyMap& map, int x, int y, int z, bool is_occupied) {
  map.set({static_cast<std::uint16_t>(32768 + x), static_cast<std::uint16_t>(32768 + y),
           static_cast<std::uint16_t>(32768 + z)},
          {.log_odds = is_occupied ? 1.0F : -1.0F});
}

/// A floor of three by two voxels at z = 0, air above it, a box on it, a lamp at z = 4.
UncertaintyMap room() {
  UncertaintyMap map(0.5);
  for (int x = -1; x <= 1; ++x) {
    for (int y = 2; y <= 3; ++y) {
      set_voxel(map, x, y, 0, true);
      if (x < 1 || y < 3) set_voxel(map, x, y, 1, x == 0 && y == 3);
    }
  }
  set_voxel(map, -1, 2, 4, true);
  map.finish_writing();
  return map;
}

constexpr char kOccupied = '\x00';
constexpr char kFree = '\xfe';
constexpr char kUnknown = '\xcd';

TEST(FloorPlan, ShowsWhatStandsInTheBandWithYUp) {
  const TemporaryFolder folder;
  write_floor_plan(room(), folder / "plan.pgm", {.min_m = 0.5, .max_m = 1.0});
  const std::string pixels{kFree, kOccupied, kUnknown, kFree, kFree, kFree};
  // The column whose voxel in the band is unknown is at the edge and known in another row.
  EXPECT_EQ(bytes_in(folder / "plan.pgm"), "P5\n3 2\n255\n" + pixels);
  // A whole map's floor is occupied everywhere.
  write_floor_plan(room(), folder / "plan.pgm");
  EXPECT_EQ(bytes_in(folder / "plan.pgm"), "P5\n3 2\n255\n" + std::string(6, kOccupied));
}

TEST(FloorPlan, CountsAVoxelByItsCentre) {
  const TemporaryFolder folder;
  const auto first_pixel = [&](const HeightBand& band) {
    write_floor_plan(room(), folder / "plan.pgm", band);
    return bytes_in(folder / "plan.pgm").substr(11, 1)[0];
  };
  EXPECT_EQ(first_pixel({.min_m = 0.25, .max_m = 0.25}), kOccupied);  // the floor's centre
  EXPECT_EQ(first_pixel({.min_m = 0.26, .max_m = 1.0}), kFree);
  EXPECT_THAT(test::message_of<InputError>([&] { first_pixel({.min_m = 0.26, .max_m = 0.74}); }),
              HasSubstr("nothing is known in the height band"));
}

TEST(FloorPlan, MeansWhatMapServerReads) {
  const TemporaryFolder folder;
  write_floor_plan(room(), folder / "john's: plan.yaml");
  const YAML::Node meaning = YAML::LoadFile(folder / "john's: plan.yaml");
  EXPECT_EQ(meaning["image"].as<std::string>(), "john's: plan.pgm");
  EXPECT_EQ(meaning["resolution"].as<double>(), 0.5);
  EXPECT_EQ(meaning["origin"].as<std::vector<double>>(), (std::vector<double>{-0.5, 1.0, 0.0}));
  EXPECT_EQ(meaning["negate"].as<int>(), 0);
  // map_server takes the darkness for the probability of being occupied.
  const auto state = [&](char pixel) {
    const double p = (255 - static_cast<unsigned char>(pixel)) / 255.0;
    if (p > meaning["occupied_thresh"].as<double>()) return VoxelState::occupied;
    return p < meaning["free_thresh"].as<double>() ? VoxelState::free : VoxelState::unknown;
  };
  EXPECT_EQ(state(kOccupied), VoxelState::occupied);
  EXPECT_EQ(state(kFree), VoxelState::free);
  EXPECT_EQ(state(kUnknown), VoxelState::unknown);
}

TEST(FloorPlan, IsRefusedWhereItCannotBe) {
  const TemporaryFolder folder;
  const auto refusal_of = [&](const UncertaintyMap& map, const HeightBand& band) {
    return test::message_of<InputError>([&] { write_floor_plan(map, folder / "p.pgm", band); });
  };
  EXPECT_THAT(refusal_of(room(), {.min_m = 2.0, .max_m = 1.0}), HasSubstr("lower end, 2 m"));
  EXPECT_THAT(refusal_of(UncertaintyMap(0.1), {}), HasSubstr("nothing is known"));
  UncertaintyMap wide = room();
  set_voxel(wide, 30000, 30000, 0, true);
  EXPECT_THAT(refusal_of(wide, {}), HasSubstr("more than the 100000000"));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(FloorPlan, NeverStandsBesideTheMeaningOfAnother) {
  const TemporaryFolder folder;
  write_floor_plan(room(), folder / "p.pgm");
  const std::string old_picture = bytes_in(folder / "p.pgm");
  const std::string old_meaning = bytes_in(folder / "p.yaml");
  write_floor_plan(room(), folder / "p.pgm", {.min_m = 2.0});
  EXPECT_NE(bytes_in(folder / "p.pgm"), old_picture);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);

  // Where the picture cannot be written, the older pair stays.
  std::filesystem::remove(folder / "p.pgm");
  std::filesystem::create_directory(folder / "p.pgm");
  const std::string meaning = bytes_in(folder / "p.yaml");
  EXPECT_NE(test::message_of<InputError>([&] { write_floor_plan(room(), folder / "p.pgm"); }), "");
  EXPECT_EQ(bytes_in(folder / "p.yaml"), meaning);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

}  // namespace
}  // namespace nbvopt
