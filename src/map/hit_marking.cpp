#include "map/hit_marking.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "map/parts.hpp"

namespace nbvopt {

namespace {

constexpr std::size_t kHitsAPart = 4096;

/// Where the hits stand in window.hit_voxels().
std::vector<std::uint32_t> marked_places(std::span<const ScanHit> hits, MarkWindow& window) {
  std::vector<std::uint32_t> places;
  places.reserve(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const bool is_as_before = i > 0 && hits[i].key == hits[i - 1].key;
    places.push_back(is_as_before ? places.back() : window.mark_hit(hits[i].key));
  }
  return places;
}

void add_colours(std::span<const ScanHit> hits, std::span<const std::uint32_t> places,
                 const Scan& scan, std::span<HitVoxel> voxels) {
  if (scan.colours.empty()) return;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    HitVoxel& voxel = voxels[places[i]];
    for (int c = 0; c < 3; ++c) voxel.colour_sum[c] += scan.colours[hits[i].point][c];
    ++voxel.coloured_points;
  }
}

/// Equation (9) within the scan. The point of a voxel that has the least bound comes first; after
/// it few others can have less.
void add_uncertainties(std::span<const ScanHit> hits, std::span<const std::uint32_t> places,
                       const ScanUncertainty& uncertainty, std::span<HitVoxel> voxels) {
  std::vector<float> bounds(hits.size());
  for_each_part(hits.size(), kHitsAPart, [&](std::size_t first, std::size_t last) {
    uncertainty.bound(hits.subspan(first, last - first),
                      std::span(bounds).subspan(first, last - first));
  });

  struct Least {
    float bound = std::numeric_limits<float>::infinity();
    std::size_t hit = 0;
  };
  std::vector<Least> least(voxels.size());
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (bounds[i] < least[places[i]].bound) least[places[i]] = {bounds[i], i};
  }
  const auto add = [&](std::size_t hit) {
    float& least_u = voxels[places[hit]].uncertainty;
    least_u = std::min(least_u, uncertainty.of(hits[hit]));
  };
  for (const Least& first : least) add(first.hit);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (bounds[i] < voxels[places[i]].uncertainty && least[places[i]].hit != i) add(i);
  }
}

}  // namespace

void mark_hits(std::span<const ScanHit> hits, const Scan& scan, const ScanUncertainty& uncertainty,
               MarkWindow& window) {
  if (hits.empty()) return;
  const std::vector<std::uint32_t> places = marked_places(hits, window);
  add_colours(hits, places, scan, window.hit_voxels());
  add_uncertainties(hits, places, uncertainty, window.hit_voxels());
}

}  // namespace nbvopt
