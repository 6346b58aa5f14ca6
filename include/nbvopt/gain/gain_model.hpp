// What a view is worth: Eq. 12 a ray, Eq. 13 a view.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "nbvopt/gain/ray_caster.hpp"
#include "nbvopt/sensor/depth_camera.hpp"

namespace nbvopt {

/// The gain of one view and how its rays ended; born as "not evaluated".
struct ViewGain {
  double gain = std::numeric_limits<double>::quiet_NaN();
  double unknown_gain = 0.0;   ///< the part that comes from unknown voxels
  double occupied_gain = 0.0;  ///< the part that comes from badly seen ones
  int unknown_rays = 0;
  int occupied_rays = 0;
  int free_rays = 0;  ///< all the rest: free to the far end, or blocked at the near end

  bool operator==(const ViewGain&) const = default;
};

/// Storage that a gain model reuses from view to view; keep one a thread.
struct GainScratch {
  std::vector<double> ray_gain;         ///< of each ray, counted on its own
  std::vector<std::uint32_t> best_ray;  ///< a hash table of voxels
};

/// Turns the hits of the camera's rays into the gain of the view. Implementations are const and
/// safe to share between threads.
class GainModel {
 public:
  virtual ~GainModel() = default;
  virtual std::string name() const = 0;
  /// `hits` are those of the camera's rays(), in their order.
  virtual ViewGain gain(const RayHits& hits, GainScratch& scratch) const = 0;
};

/// The paper's gain: a ray that ends unknown gives 1 - u_new, one that ends occupied
/// max(0, u_old - u_new) (Eq. 12), summed over rays or over distinct voxels (Eq. 13), as
/// SensorOptions::counting says. Counts of rays are the same in both.
std::unique_ptr<GainModel> make_paper_gain(const DepthCamera& camera);

/// The gain models by name; "paper" is the default.
std::vector<std::string> gain_model_names();
/// Throws UsageError that lists the names when `name` is not one of them.
std::unique_ptr<GainModel> make_gain_model(const std::string& name, const DepthCamera& camera);

}  // namespace nbvopt
