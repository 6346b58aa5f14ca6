// No view of a box gains more than the box's bound.
#include "gain/gain_bound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "nbvopt/gain/view_evaluator.hpp"
#include "nbvopt/sensor/depth_camera.hpp"
#include "support/made_map.hpp"
#include "support/sanitizers.hpp"

namespace nbvopt::test {
namespace {

using detail::BoundBlock;
using detail::GainBound;

/// Where a mast stands in a map, and what its reach is.
struct Scene {
  Scene() {
    sensor.horizontal_rays = 12;
    sensor.vertical_rays = 9;
    sensor.range_max_m = 2.0;
  }

  UncertaintyMap map{0.1};
  SensorOptions sensor;
  MastOptions mast;
  Transform T_map_base = base_pose(0.03, -0.02, 0.0, 0.4);
  BaseTwist twist;
  JointPosition joints{0.2, -0.1, 0.4};
  double motion_time_s = 0.4;
  HazardTable hazards;
};

/// A free room with walls that were seen more or less well, and a half that is not known.
void furnish_room(Scene& scene) {
  std::mt19937_64 random(5);
  const KeyBox room = keys_between(scene.map.lattice(), {-1.2, -1.0, -0.1}, {1.4, 1.2, 1.3});
  for_each_key(room, [&](VoxelKey key) {
    const bool is_wall =
        key.x == room.min.x || key.x == room.max.x || key.y == room.min.y || key.z == room.min.z;
    if (key.y > room.max.y - 5) return;
    scene.map.set(key, is_wall ? occupied(static_cast<float>(uniform(random))) : kFree);
  });
  set_box(scene.map, keys_between(scene.map.lattice(), {0.6, -0.4, 0.0}, {0.9, 0.2, 0.6}),
          occupied(0.7F));
}

/// Voxels by chance right up to the camera.
void furnish_clutter(Scene& scene, double clutter) {
  std::mt19937_64 random(7);
  scatter(scene.map, keys_between(scene.map.lattice(), {-1.5, -1.5, -1.0}, {1.5, 1.5, 1.8}),
          clutter, random);
}

class Reach {
 public:
  explicit Reach(const Scene& scene)
      : grid_(VoxelGrid::whole(scene.map)),
        mast_(Mast(scene.mast), scene.T_map_base, scene.twist, scene.joints),
        box_(mast_.mast().reachable_box(scene.joints, scene.motion_time_s)),
        evaluator_(make_exact_evaluator(grid_, DepthCamera(scene.sensor), scene.hazards)),
        bound_(*grid_, scene.sensor, mast_, box_) {
    levels_.push_back(bound_.roots());
    for (int level = 0;; ++level) {
      for (BoundBlock& block : levels_.back()) bound_.tighten(block, -1.0F, {});
      if (level == 3) break;
      std::vector<BoundBlock> finer;
      for (const BoundBlock& block : levels_.back()) {
        std::ranges::move(bound_.children(block, -1.0F), std::back_inserter(finer));
      }
      levels_.push_back(std::move(finer));
    }
  }

  /// Of random views and the boxes of all levels that hold them, how many views gain more than
  /// `factor` times the box's bound.
  int violations(int views, double factor) const {
    std::mt19937_64 random(11);
    int count = 0;
    for (int i = 0; i < views; ++i) {
      Eigen::Vector3d q;
      for (int j = 0; j < 3; ++j) {
        // Faces of the reach are where answers lie.
        const int place = uniform_int(random, 0, 9);
        q[j] = place == 0   ? box_.min[j]
               : place == 1 ? box_.max[j]
                            : uniform(random, box_.min[j], box_.max[j]);
      }
      const double gain = evaluator_->evaluate(mast_.T_map_sensor(JointPosition::from(q))).gain;
      for (const std::vector<BoundBlock>& level : levels_) {
        count += gain > factor * bound_at(level, q);
      }
    }
    return count;
  }

  int levels() const { return static_cast<int>(levels_.size()); }

 private:
  double bound_at(const std::vector<BoundBlock>& level, const Eigen::Vector3d& q) const {
    for (const BoundBlock& block : level) {
      const JointBox first = bound_.box_of(block, 0, 0);
      const double bin = first.max[0] - first.min[0];
      if (q[2] < first.min[2] || q[2] > first.max[2]) continue;
      const int pan = static_cast<int>(std::floor((q[0] - first.min[0]) / bin));
      const int tilt = static_cast<int>(std::floor((q[1] - first.min[1]) / bin));
      // The face at the far end of the reach may be beyond the last bin by rounding.
      const int p = pan == block.pans && q[0] == box_.max[0] ? pan - 1 : pan;
      const int t = tilt == block.tilts && q[1] == box_.max[1] ? tilt - 1 : tilt;
      if (p < 0 || t < 0 || p >= block.pans || t >= block.tilts) continue;
      return block.row(t)[p - block.pan_begin];
    }
    ADD_FAILURE() << "no box holds " << q.transpose();
    return 0.0;
  }

  std::shared_ptr<const VoxelGrid> grid_;
  MovingMast mast_;
  JointBox box_;
  std::unique_ptr<const ViewEvaluator> evaluator_;
  GainBound bound_;
  std::vector<std::vector<BoundBlock>> levels_;
};

struct Variation {
  const char* name;
  void (*change)(Scene&);
};

void PrintTo(const Variation& variation, std::ostream* out) { *out << variation.name; }

class GainBoundTest : public testing::TestWithParam<Variation> {};

// Four boxes a view: a million pairs of a view and a box in all variations together.
constexpr int kViews = test::kAddressSanitizer ? 500 : 8'000;

TEST_P(GainBoundTest, NoViewOfABoxGainsMore) {
  const std::map<std::string, void (*)(Scene&)> maps{
      {"room", [](Scene& scene) { furnish_room(scene); }},
      {"sparse clutter", [](Scene& scene) { furnish_clutter(scene, 0.02); }},
      {"dense clutter", [](Scene& scene) { furnish_clutter(scene, 0.3); }}};
  for (const auto& [name, furnish] : maps) {
    SCOPED_TRACE(name);
    Scene scene;
    furnish(scene);
    GetParam().change(scene);
    const Reach reach(scene);
    EXPECT_EQ(reach.levels(), 4);
    EXPECT_EQ(reach.violations(kViews, 1.0), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Variations, GainBoundTest,
    testing::Values(
        Variation{"Plain", [](Scene&) {}},
        Variation{"PerVoxel", [](Scene& scene) { scene.sensor.counting = Counting::per_voxel; }},
        Variation{"LeverArm",
                  [](Scene& scene) {
                    scene.mast.sensor_offset_m = {0.08, -0.03, 0.05};
                  }},
        Variation{"MovingBaseWithMastBeside",
                  [](Scene& scene) {
                    scene.twist = {0.06, -0.02, 0.5};
                    scene.mast.pan_axis_x_m = -0.04;
                    scene.mast.pan_axis_y_m = 0.03;
                  }},
        Variation{
            "TiltedBase",
            [](Scene& scene) {
              scene.T_map_base.linear() =
                  Eigen::AngleAxisd(0.2, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
            }},
        Variation{"SeesThroughTheNear", [](Scene& scene) { scene.sensor.near_blocking = false; }},
        Variation{"DepthAlongTheAxis",
                  [](Scene& scene) { scene.sensor.range_axis = RangeAxis::z_depth; }},
        Variation{"Normals", [](Scene& scene) { scene.sensor.normal_weight = 0.3; }},
        Variation{"Expected", [](Scene& scene) { scene.sensor.gain = GainKind::expected; }},
        Variation{"ExpectedPerVoxel",
                  [](Scene& scene) {
                    scene.sensor.gain = GainKind::expected;
                    scene.sensor.counting = Counting::per_voxel;
                  }},
        Variation{"LooksUp",
                  [](Scene& scene) {
                    scene.mast.tilt_max_rad = 1.5;
                    scene.joints.tilt_rad = 1.35;
                  }}),
    [](const testing::TestParamInfo<Variation>& variation) { return variation.param.name; });

TEST(GainBound, AFewPercentLessWouldBeFound) {
  Scene scene;
  furnish_room(scene);
  EXPECT_GT(Reach(scene).violations(2'000, 0.9), 0);
}

}  // namespace
}  // namespace nbvopt::test
