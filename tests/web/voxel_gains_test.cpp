#include "web/voxel_gains.hpp"

#include <gmock/gmock.h>

#include <set>

#include "nbvopt/gain/view_evaluator.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

/// The camera in the middle of a cube of random voxels, in a free space of its own.
UncertaintyMap cluttered_map(double clutter = 0.02) {
  UncertaintyMap map(0.1);
  std::mt19937_64 random(3);
  scatter(map, cube(key_from_origin(-20, -20, -20), 41), clutter, random);
  set_box(map, cube(key_from_origin(-6, -6, -6), 13), kFree);
  map.finish_writing();
  return map;
}

Transform view_of_clutter() {
  Transform T_map_sensor = base_pose(0.03, 0.02, 0.05, 0.4);
  T_map_sensor.linear() *= rotation_body_sensor();
  return T_map_sensor;
}

/// Hazards in which contexts differ.
HazardTable taught_hazards() {
  HazardTable hazards;
  for (std::size_t context = 0; context < HazardTable::kContexts; ++context) {
    hazards.add(context, {1.0 + static_cast<double>(context), 4.0});
  }
  return hazards;
}

double sum_of(const std::vector<VoxelGain>& voxels) {
  double sum = 0.0;
  for (const VoxelGain& voxel : voxels) sum += voxel.gain;
  return sum;
}

TEST(VoxelGains, AddUpToTheViews) {
  const UncertaintyMap map = cluttered_map();
  const auto grid = VoxelGrid::whole(map);
  const Transform T_map_sensor = view_of_clutter();
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    SensorOptions sensor;
    sensor.counting = counting;
    sensor.normal_weight = 0.25;
    const ViewGain view = make_exact_evaluator(grid, DepthCamera(sensor))->evaluate(T_map_sensor);
    double unknown = 0.0;
    double occupied_sum = 0.0;
    std::set<std::uint64_t> voxels;
    for (const VoxelGain& voxel : voxel_gains(grid, sensor, HazardTable(), T_map_sensor).voxels) {
      EXPECT_TRUE(voxels.insert(packed(voxel.key)).second);
      EXPECT_EQ(voxel.state, map.at(voxel.key).state);
      EXPECT_GT(voxel.gain, 0.0);
      (voxel.state == VoxelState::occupied ? occupied_sum : unknown) += voxel.gain;
    }
    EXPECT_GT(view.unknown_gain, 10.0);
    EXPECT_GT(view.occupied_gain, 1.0);
    EXPECT_NEAR(unknown, view.unknown_gain, 1e-9 * view.gain);
    EXPECT_NEAR(occupied_sum, view.occupied_gain, 1e-9 * view.gain);
  }
}

TEST(VoxelGains, OfEveryGainThatIsASumAddUpToTheViews) {
  const UncertaintyMap map = cluttered_map(0.2);
  const auto grid = VoxelGrid::whole(map);
  const HazardTable hazards = taught_hazards();
  std::vector<GainChoice> choices;
  for (const GainKind kind :
       {GainKind::expected, GainKind::occlusion_aware, GainKind::unobserved_voxel,
        GainKind::rear_side_voxel, GainKind::rear_side_entropy, GainKind::proximity_count,
        GainKind::voxel_weight}) {
    choices.emplace_back(kind);
  }
  choices.emplace_back(std::vector<GainTerm>{
      {GainKind::positive, 2.0}, {GainKind::expected, 0.5}, {GainKind::proximity_count, 0.25}});
  for (const Counting counting : {Counting::per_ray, Counting::per_voxel}) {
    for (const GainChoice& choice : choices) {
      if (counting == Counting::per_voxel && !choice.is_of_paper()) continue;  // is refused
      SensorOptions sensor;
      sensor.horizontal_rays = 24;
      sensor.vertical_rays = 18;
      sensor.counting = counting;
      sensor.gain = choice;
      const double gain = make_exact_evaluator(grid, DepthCamera(sensor), hazards)
                              ->evaluate(view_of_clutter())
                              .gain;
      const VoxelGains gains = voxel_gains(grid, sensor, hazards, view_of_clutter());
      EXPECT_EQ(gains.why_none, "");
      std::set<std::uint64_t> voxels;
      for (const VoxelGain& voxel : gains.voxels) {
        EXPECT_TRUE(voxels.insert(packed(voxel.key)).second);
        EXPECT_EQ(voxel.state, map.at(voxel.key).state);
      }
      EXPECT_GT(gain, 0.1) << to_string(choice);
      // The vectorised walk of the expected gain has single precision.
      EXPECT_NEAR(sum_of(gains.voxels), gain, 1e-5 * gain) << to_string(choice);
    }
  }
}

TEST(VoxelGains, AreNotThereWhereTheGainIsNoSum) {
  const UncertaintyMap map = cluttered_map();
  const auto grid = VoxelGrid::whole(map);
  for (const GainKind kind : {GainKind::vasquez_gomez_area, GainKind::average_entropy}) {
    SensorOptions sensor;
    sensor.gain = GainChoice({{GainKind::positive, 1.0}, {kind, 1.0}});
    const VoxelGains gains = voxel_gains(grid, sensor, HazardTable(), view_of_clutter());
    EXPECT_TRUE(gains.voxels.empty());
    EXPECT_EQ(gains.why_none, "the gain " + to_string(GainChoice(kind)) +
                                  " is no sum over voxels: none has a part in it");
  }
}

}  // namespace
}  // namespace nbvopt::test
