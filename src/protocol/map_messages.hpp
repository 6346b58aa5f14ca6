// Between messages of scans and maps and the library's own types, both ways.
//
// What comes from a message is checked: a needed field that is not set, a number that is not finite
// and records that are cut short are refused with an InputError that names the field.
#pragma once

#include <cstdint>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

MapFormat from_message(v1::MapFormat format);

/// The scan of a request, which has at most so many points (rays without a return, pixels).
/// Throws LimitError when it has more.
Scan scan_from_message(const v1::InsertScanRequest& request, std::uint64_t max_points);

v1::MapFormat to_message(MapFormat format);
v1::PointCloud to_message(const Scan& scan);

}  // namespace nbvopt
