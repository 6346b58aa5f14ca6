#include "bench/soak_model.hpp"

#include <sstream>
#include <stdexcept>
#include <utility>

#include "nbvopt/map/map_file.hpp"

namespace nbvopt::bench {

namespace {

UncertaintyMap copy_of(const UncertaintyMap& map) {
  std::istringstream file(map_file_bytes(map, MapFormat::uncertainty_ot));
  return read_map(file, "the model");
}

}  // namespace

SoakModel::SoakModel(double resolution_m, std::uint64_t version)
    : newest_(resolution_m), durable_(resolution_m), version_(version), durable_version_(version) {}

std::string SoakModel::bytes() const { return map_file_bytes(newest_, MapFormat::uncertainty_ot); }

void SoakModel::apply(Change change) {
  change(newest_);
  ++version_;
  since_durable_.push_back(std::move(change));
}

void SoakModel::make_durable(std::uint64_t version) {
  for (; durable_version_ < version && !since_durable_.empty(); ++durable_version_) {
    since_durable_.front()(durable_);
    since_durable_.pop_front();
  }
  if (durable_version_ < version) throw std::runtime_error("a version is durable that never was");
}

void SoakModel::come_back_with(std::uint64_t version) {
  if (version < durable_version_ || version > version_) {
    throw std::runtime_error("the server came back with version " + std::to_string(version) +
                             ", of " + std::to_string(durable_version_) + " (durable) to " +
                             std::to_string(version_));
  }
  make_durable(version);
  newest_ = copy_of(durable_);
  version_ = version;
  since_durable_.clear();
}

}  // namespace nbvopt::bench
