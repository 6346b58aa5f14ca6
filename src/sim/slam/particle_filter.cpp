#include "sim/slam/particle_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/uniform.hpp"
#include "map/parts.hpp"
#include "sim/slam/scan_matcher.hpp"

namespace nbvopt {
namespace {

constexpr std::size_t kParticles = 30;
constexpr double kCell_m = 0.05;
/// Scans are less independent than the likelihood takes them for: GMapping's ogain.
constexpr double kLikelihoodGain = 3.0 * kParticles;
constexpr double kEffectiveShareMin = 0.5;

std::vector<Eigen::Vector2f> hits_of(std::span<const PlaneBeam> scan) {
  std::vector<Eigen::Vector2f> hits_base_m;
  hits_base_m.reserve(scan.size());
  for (const PlaneBeam& beam : scan) {
    if (beam.is_hit) hits_base_m.emplace_back(beam.end_base_m.cast<float>());
  }
  return hits_base_m;
}

/// Enters a scan from a pose.
void enter(TileGrid& grid, const PlanarPose& T_map_base, std::span<const PlaneBeam> scan) {
  const Eigen::Rotation2Dd R_map_base(T_map_base.yaw_rad);
  const Eigen::Vector2d origin_map_m(T_map_base.x_m, T_map_base.y_m);
  std::vector<Beam> beams;
  beams.reserve(scan.size());
  for (const PlaneBeam& beam : scan) {
    beams.push_back({origin_map_m + R_map_base * beam.end_base_m, beam.is_hit});
  }
  grid.insert_scan(origin_map_m, beams);
}

}  // namespace

ParticleFilter::ParticleFilter(const MotionModel& model, const PlanarPose& T_map_base,
                               std::span<const PlaneBeam> scan, std::uint64_t seed)
    : model_(model) {
  std::seed_seq seeds{seed, seed >> 32, std::uint64_t{0x51a}};
  generator_.seed(seeds);
  TileGrid grid(kCell_m);
  enter(grid, T_map_base, scan);
  for (std::size_t i = 0; i < kParticles; ++i) {
    particles_.push_back({T_map_base, 0.0, 0.0, grid.share()});
  }
}

void ParticleFilter::update(const PlanarPose& motion, std::span<const PlaneBeam> scan) {
  for (Particle& particle : particles_) {
    particle.T_map_base =
        particle.T_map_base * model_.erring(motion, MotionModel::draw_normals(generator_));
  }
  const std::vector<Eigen::Vector2f> hits_base_m = hits_of(scan);
  for_each_part(particles_.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Particle& particle = particles_[i];
      const ScanMatch match = match_scan(particle.grid, hits_base_m, particle.T_map_base);
      particle.T_map_base = match.T_map_base;
      particle.log_weight += match.log_likelihood;
      particle.log_likelihood += match.log_likelihood;
      enter(particle.grid, particle.T_map_base, scan);
    }
  });
  resample();
}

PlanarPose ParticleFilter::fit(const PlanarPose& guess_T_map_base,
                               std::span<const PlaneBeam> scan) const {
  return match_scan(best().grid, hits_of(scan), guess_T_map_base).T_map_base;
}

const ParticleFilter::Particle& ParticleFilter::best() const {
  return *std::ranges::max_element(particles_, {}, &Particle::log_likelihood);
}

void ParticleFilter::resample() {
  const double heaviest =
      std::ranges::max_element(particles_, {}, &Particle::log_weight)->log_weight;
  std::vector<double> weights;
  double sum = 0.0;
  double sum_of_squares = 0.0;
  for (const Particle& particle : particles_) {
    weights.push_back(std::exp((particle.log_weight - heaviest) / kLikelihoodGain));
    sum += weights.back();
    sum_of_squares += weights.back() * weights.back();
  }
  const double effective = sum * sum / sum_of_squares;
  if (effective >= kEffectiveShareMin * static_cast<double>(kParticles)) return;

  // Systematic: one draw, then equal steps over the weights laid end to end.
  const double step = sum / static_cast<double>(kParticles);
  double threshold = step * uniform(generator_);
  double passed = 0.0;
  std::vector<Particle> drawn;
  drawn.reserve(kParticles);
  for (std::size_t i = 0; i < kParticles; ++i) {
    passed += weights[i];
    Particle& particle = particles_[i];
    particle.log_weight = 0.0;
    const bool is_last = i + 1 == kParticles;
    std::size_t copies = 0;
    for (; drawn.size() + copies < kParticles && (threshold < passed || is_last); ++copies) {
      threshold += step;
    }
    for (; copies > 1; --copies) {
      drawn.push_back({particle.T_map_base, 0.0, particle.log_likelihood, particle.grid.share()});
    }
    if (copies == 1) drawn.push_back(std::move(particle));
  }
  particles_ = std::move(drawn);
}

}  // namespace nbvopt
