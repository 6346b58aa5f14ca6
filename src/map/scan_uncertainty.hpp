// How uncertain the points of a scan are.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "map/scan_rays.hpp"
#include "nbvopt/sensor/uncertainty_model.hpp"
#include "sensor/uncertainty_bound.hpp"

namespace nbvopt {

class ScanUncertainty {
 public:
  /// The scan, the sensor and what `rays` refer to must outlive it.
  ScanUncertainty(const Scan& scan, const Transform& T_map_sensor, const SensorOptions& sensor,
                  const Lattice& lattice);

  /// u of a hit (Eq. 8), with the normal there, where normals count.
  float of(const ScanHit& hit) const;

  /// At most of(hit), for all hits; quick.
  void bound(std::span<const ScanHit> hits, std::span<float> bounds) const;

 private:
  Eigen::Vector3d normal_sensor(const ScanHit& hit) const;

  const Scan& scan_;
  const Transform& T_map_sensor_;
  const Lattice& lattice_;
  UncertaintyModel model_;
  UncertaintyBound bound_;
  std::vector<Eigen::Vector3f> normals_;  ///< of all points, in the sensor frame; or none
};

}  // namespace nbvopt
