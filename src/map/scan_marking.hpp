// Marks the voxels that a scan's rays pass.
#pragma once

#include "map/mark_window.hpp"
#include "map/scan_rays.hpp"
#include "nbvopt/core/stop.hpp"

namespace nbvopt {

/// Marks what the rays pierce within the window as SegmentWalk walks them one by one, but walks few
/// of them: a ray only where not all is marked that the rays around it can pass. Call it after all
/// hits are marked. Some milliseconds after it was cancelled it returns, with marks that are
/// missing.
void mark_rays(const ScanRays& rays, const CancelToken& cancel, MarkWindow& window);

}  // namespace nbvopt
