// The contract of every gain model, on hits made up by chance.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>
#include <tuple>

#include "nbvopt/core/error.hpp"
#include "nbvopt/gain/gain_model.hpp"
#include "support/made_map.hpp"

namespace nbvopt::test {
namespace {

using ModelAndCounting = std::tuple<std::string, Counting>;

class GainModelContract : public ::testing::TestWithParam<ModelAndCounting> {
 protected:
  /// 63 rays, which no vector divides.
  static DepthCamera camera() {
    SensorOptions sensor;
    sensor.horizontal_rays = 9;
    sensor.vertical_rays = 7;
    sensor.counting = std::get<Counting>(GetParam());
    return DepthCamera(sensor);
  }

  const DepthCamera camera_ = camera();
  const std::unique_ptr<GainModel> model_ =
      make_gain_model(std::get<std::string>(GetParam()), camera_);
};

/// Hits of all kinds, on so few voxels that many rays share one. A voxel is of one kind and has
/// one u.
RayHits random_hits(std::size_t n, std::mt19937_64& random) {
  RayHits hits;
  hits.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const int voxel = uniform_int(random, 0, 20);
    hits.kind[i] = static_cast<HitKind>(voxel % 4);
    hits.face[i] = static_cast<Face>(uniform_int(random, 0, 6));
    hits.voxel[i] = key_from_origin(voxel, 3 * voxel, -voxel);
    hits.distance_m[i] = uniform(random, 0.5, 4.0);
    hits.uncertainty[i] =
        hits.kind[i] == HitKind::occupied ? static_cast<float>(voxel) / 20.0F : kUnknownUncertainty;
  }
  return hits;
}

/// The hits of the camera's rays in another order.
RayHits reordered(const RayHits& hits, const std::vector<std::size_t>& order) {
  RayHits result;
  result.resize(hits.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    result.kind[i] = hits.kind[order[i]];
    result.face[i] = hits.face[order[i]];
    result.voxel[i] = hits.voxel[order[i]];
    result.distance_m[i] = hits.distance_m[order[i]];
    result.uncertainty[i] = hits.uncertainty[order[i]];
  }
  return result;
}

/// The ray that points where each ray's mirror image does.
std::vector<std::size_t> mirrored(const CameraRays& rays, double sign_x, double sign_y) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Eigen::Vector3d wanted(sign_x * rays.x[i], sign_y * rays.y[i], rays.z[i]);
    std::size_t j = 0;
    while ((rays.direction(j) - wanted).norm() > 1e-9) ++j;
    order.push_back(j);
  }
  return order;
}

TEST_P(GainModelContract, IsMadeUnderItsName) {
  EXPECT_EQ(model_->name(), std::get<std::string>(GetParam()));
}

TEST_P(GainModelContract, IsFiniteAndItsPartsAddUp) {
  std::mt19937_64 random(1);
  GainScratch scratch;
  for (int repeat = 0; repeat < 100; ++repeat) {
    const ViewGain view = model_->gain(random_hits(camera_.rays().size(), random), scratch);
    EXPECT_TRUE(std::isfinite(view.gain));
    EXPECT_GE(view.unknown_gain, 0.0);
    EXPECT_GE(view.occupied_gain, 0.0);
    EXPECT_GT(view.gain, 0.0);
    EXPECT_DOUBLE_EQ(view.gain, view.unknown_gain + view.occupied_gain);
    EXPECT_EQ(view.unknown_rays + view.occupied_rays + view.free_rays, 63);
  }
}

/// The camera is the same to the left and the right, up and down, so its mirrored view is worth
/// the same; and so is the view with its rays in another order.
TEST_P(GainModelContract, DoesNotDependOnTheOrderOfRays) {
  std::mt19937_64 random(2);
  GainScratch scratch;
  for (const auto& [sign_x, sign_y] : {std::pair{-1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}}) {
    const std::vector<std::size_t> order = mirrored(camera_.rays(), sign_x, sign_y);
    for (int repeat = 0; repeat < 20; ++repeat) {
      const RayHits hits = random_hits(camera_.rays().size(), random);
      const ViewGain view = model_->gain(hits, scratch);
      const ViewGain mirror = model_->gain(reordered(hits, order), scratch);
      EXPECT_NEAR(view.unknown_gain, mirror.unknown_gain, 1e-12 * view.gain);
      EXPECT_NEAR(view.occupied_gain, mirror.occupied_gain, 1e-12 * view.gain);
      EXPECT_EQ(view.unknown_rays, mirror.unknown_rays);
      EXPECT_EQ(view.occupied_rays, mirror.occupied_rays);
    }
  }
}

TEST_P(GainModelContract, IsNothingWithoutHits) {
  std::mt19937_64 random(3);
  GainScratch scratch;
  for (const HitKind kind : {HitKind::none, HitKind::blocked}) {
    RayHits hits = random_hits(camera_.rays().size(), random);
    hits.kind.assign(hits.size(), kind);
    const ViewGain view = model_->gain(hits, scratch);
    EXPECT_EQ(view.gain, 0.0);
    EXPECT_EQ(view.free_rays, 63);
  }
}

TEST_P(GainModelContract, NeverGrowsWhenARayIsLost) {
  std::mt19937_64 random(4);
  GainScratch scratch;
  for (int repeat = 0; repeat < 100; ++repeat) {
    RayHits hits = random_hits(camera_.rays().size(), random);
    const double before = model_->gain(hits, scratch).gain;
    hits.kind[uniform_int(random, 0, 62)] = HitKind::none;
    EXPECT_LE(model_->gain(hits, scratch).gain, before + 1e-12);
  }
}

TEST_P(GainModelContract, MayBeSharedByThreadsAndScratchByViews) {
  std::mt19937_64 random(5);
  std::vector<RayHits> hits;
  std::vector<ViewGain> expected;
  for (int i = 0; i < 50; ++i) {
    hits.push_back(random_hits(camera_.rays().size(), random));
    GainScratch fresh;
    expected.push_back(model_->gain(hits.back(), fresh));
  }
  const auto run = [&](std::vector<ViewGain>& views) {
    GainScratch scratch;
    for (const RayHits& h : hits) views.push_back(model_->gain(h, scratch));
  };
  std::vector<ViewGain> here, there;
  std::thread other(run, std::ref(there));
  run(here);
  other.join();
  EXPECT_EQ(here, expected);
  EXPECT_EQ(there, expected);
}

INSTANTIATE_TEST_SUITE_P(EveryModel, GainModelContract,
                         ::testing::Combine(::testing::ValuesIn(gain_model_names()),
                                            ::testing::Values(Counting::per_ray,
                                                              Counting::per_voxel)));

TEST(GainModels, AreKnownByName) {
  const DepthCamera camera{SensorOptions{}};
  EXPECT_THROW(make_gain_model("entropy", camera), UsageError);
}

}  // namespace
}  // namespace nbvopt::test
