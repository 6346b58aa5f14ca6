// Marks the voxels that a scan hits.
#pragma once

#include <span>

#include "map/mark_window.hpp"
#include "map/scan_rays.hpp"
#include "map/scan_uncertainty.hpp"

namespace nbvopt {

/// Marks the hits' voxels, each with the least u of its points and the sum of their colours.
void mark_hits(std::span<const ScanHit> hits, const Scan& scan, const ScanUncertainty& uncertainty,
               MarkWindow& window);

}  // namespace nbvopt
