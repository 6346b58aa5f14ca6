// Voxels: their address on OctoMap's key lattice, their state, and what a change says of them.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

namespace nbvopt {

enum class VoxelState : std::uint8_t { unknown, free, occupied };

/// u of a voxel that nothing is known of (design of the model: unknown voxels have u = 1).
inline constexpr float kUnknownUncertainty = 1.0F;

/// A voxel's address at the finest resolution, as OctoMap counts: 2^15 is the voxel that starts
/// at coordinate 0.
struct VoxelKey {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  std::uint16_t z = 0;

  bool operator==(const VoxelKey&) const = default;
};

/// The key in one number, unique a voxel.
inline std::uint64_t packed(VoxelKey key) {
  return std::uint64_t{key.x} | std::uint64_t{key.y} << 16 | std::uint64_t{key.z} << 32;
}

/// The closed box of keys from `min` to `max`, both included.
struct KeyBox {
  VoxelKey min;
  VoxelKey max;

  bool operator==(const KeyBox&) const = default;
};

/// A voxel whose state or uncertainty a scan changed, with what it is now.
struct VoxelChange {
  VoxelKey key;
  VoxelState state = VoxelState::unknown;
  float uncertainty = kUnknownUncertainty;  ///< of an occupied voxel; 1 otherwise
};

/// The lattice of voxels: where keys lie in the map frame.
class Lattice {
 public:
  static constexpr int kKeyOfOrigin = 32768;

  explicit Lattice(double resolution_m) : resolution_m_(resolution_m) {}

  double resolution_m() const { return resolution_m_; }

  /// The point in lattice coordinates: voxel k spans [k, k + 1).
  Eigen::Vector3d to_lattice(const Eigen::Vector3d& p_map_m) const {
    return (p_map_m.array() / resolution_m_ + kKeyOfOrigin).matrix();
  }

  /// Whether the point lies on the lattice, which holds 2^16 voxels an axis.
  bool contains(const Eigen::Vector3d& p_map_m) const { return holds(to_lattice(p_map_m)); }

  /// The same of a point in lattice coordinates.
  static bool holds(const Eigen::Vector3d& p) {
    return (p.array() >= 0.0).all() && (p.array() < 65536.0).all();
  }

  /// The voxel that holds the point; the nearest one when it lies off the lattice.
  VoxelKey key(const Eigen::Vector3d& p_map_m) const {
    const Eigen::Array3d k = to_lattice(p_map_m).array().floor().max(0.0).min(65535.0);
    return {static_cast<std::uint16_t>(k.x()), static_cast<std::uint16_t>(k.y()),
            static_cast<std::uint16_t>(k.z())};
  }

  /// The voxel's centre in the map frame, metres.
  Eigen::Vector3d centre_m(VoxelKey key) const {
    return (Eigen::Array3d(key.x, key.y, key.z) - kKeyOfOrigin + 0.5).matrix() * resolution_m_;
  }

 private:
  double resolution_m_;
};

}  // namespace nbvopt
