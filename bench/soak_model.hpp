// What a server's map must be, as its client knows it.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>

#include "nbvopt/map/scan.hpp"

namespace nbvopt::bench {

/// The map of the newest version, and that of the last version that was told to be durable with
/// all that was done since: a server that was killed comes back with some version in between.
class SoakModel {
 public:
  using Change = std::function<void(UncertaintyMap& map)>;

  /// An empty map.
  SoakModel(double resolution_m, std::uint64_t version);

  std::uint64_t version() const { return version_; }
  std::uint64_t durable_version() const { return durable_version_; }

  /// The newest version as a file.
  std::string bytes() const;

  /// What makes the next version of the newest.
  void apply(Change change);

  /// The server has told that this version is on its disk.
  void make_durable(std::uint64_t version);

  /// The server has come back with this version. Throws std::runtime_error where it was told that
  /// a newer one is durable, or never was such a version.
  void come_back_with(std::uint64_t version);

 private:
  UncertaintyMap newest_;
  UncertaintyMap durable_;
  std::uint64_t version_;
  std::uint64_t durable_version_;
  std::deque<Change> since_durable_;
};

}  // namespace nbvopt::bench
