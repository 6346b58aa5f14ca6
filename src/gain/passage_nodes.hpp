// The hits of a ray in unknown space as two weighted ones.
#pragma once

#include <array>
#include <cmath>

#include "gain/ray_passages.hpp"

namespace nbvopt::detail {

struct PassageNode {
  double distance_m = 0.0;
  double probability = 0.0;
};

/// Gauss quadrature with two nodes: what is cubic in the distance has the same expectation over the
/// nodes as over the hits of ray i. Where the hits lie within a millimetre, one node holds them.
inline std::array<PassageNode, 2> passage_nodes(const RayPassages& passages, std::size_t i) {
  constexpr double kNarrow_m = 1e-3;
  const double p = passages.probability[i];
  if (!(p > 0.0)) return {};
  const double mean_m = passages.moment1_m[i] / p;
  const double square_m2 = passages.moment2_m2[i] / p;
  const double variance_m2 = square_m2 - mean_m * mean_m;
  if (!(variance_m2 > kNarrow_m * kNarrow_m)) return {PassageNode{mean_m, p}, PassageNode{}};
  const double third_m3 =
      passages.moment3_m3[i] / p - mean_m * (3.0 * square_m2 - 2.0 * mean_m * mean_m);
  const double deviation_m = std::sqrt(variance_m2);
  const double skewness = third_m3 / (variance_m2 * deviation_m);
  const double root = std::sqrt(4.0 + skewness * skewness);
  const double share = 0.5 * (1.0 + skewness / root);  // of the nearer node
  return {PassageNode{mean_m + 0.5 * deviation_m * (skewness - root), p * share},
          PassageNode{mean_m + 0.5 * deviation_m * (skewness + root), p * (1.0 - share)}};
}

}  // namespace nbvopt::detail
