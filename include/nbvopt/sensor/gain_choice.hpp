// What a view is worth: a gain by its name, or a weighted sum of such gains.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace nbvopt {

enum class GainKind : std::uint8_t {
  positive,  ///< the first unknown voxel on a ray is a surface (Eq. 12)
  expected,  ///< unknown space holds surfaces with the hazards of HazardTable
  // The volumetric information of Isler et al. (2016) and Delmerico et al. (2018).
  occlusion_aware,
  unobserved_voxel,
  rear_side_voxel,
  rear_side_entropy,
  proximity_count,
  vasquez_gomez_area,
  average_entropy,
  voxel_weight,  ///< how much a view adds to the weights of surface voxels (Schmid et al. 2020)
};

/// One gain of a sum.
struct GainTerm {
  GainKind kind = GainKind::positive;
  double weight = 1.0;  ///< greater than 0

  bool operator==(const GainTerm&) const = default;
};

/// A weighted sum of gains; most often one gain alone.
class GainChoice {
 public:
  GainChoice(GainKind kind = GainKind::positive) : terms_{{kind}} {}  // NOLINT: a name is a choice

  /// Throws UsageError without a term, or unless weights are finite and greater than 0.
  explicit GainChoice(std::vector<GainTerm> terms);

  const std::vector<GainTerm>& terms() const { return terms_; }
  bool has(GainKind kind) const;

  /// Whether it is `positive` or `expected` alone: what the vectorised casters and the panorama
  /// surrogate know, the sums of Eq. 12 over rays or voxels.
  bool is_of_paper() const { return *this == GainKind::positive || *this == GainKind::expected; }

  bool operator==(const GainChoice&) const = default;

 private:
  std::vector<GainTerm> terms_;
};

/// Such as "expected" or "positive + 0.5*proximity_count".
std::string to_string(const GainChoice& value);

/// The names of all gains.
std::vector<std::string> gain_names();

}  // namespace nbvopt
