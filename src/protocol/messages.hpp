// Between the messages of planner.proto and the library's own types, both ways.
//
// What comes from a message is checked: a needed field that is not set, a number that is not finite
// and records that are cut short are refused with an InputError that names the field.
#pragma once

#include <optional>
#include <string>

#include "nbvopt/map/map_file.hpp"
#include "nbvopt/map/scan.hpp"
#include "nbvopt/planner/plan.hpp"
#include "nbvopt/sensor/gain_choice.hpp"
#include "nbvopt/solver/search.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

/// `field` names the message in errors, here and below.
Transform from_message(const v1::Pose& pose, const std::string& field);
Transform from_message(const v1::BasePose& base, const std::string& field);
JointPosition from_message(const v1::JointPosition& joints, const std::string& field);
BaseTwist from_message(const v1::BaseTwist& twist, const std::string& field);
Search from_message(const v1::Search& search);
ViewGain from_message(const v1::ViewGain& view);
MapFormat from_message(v1::MapFormat format);

/// A gain's name, or a sum of gains. Throws InputError, which names `field`, for any other text.
GainChoice gain_from_text(const std::string& text, const std::string& field);

/// What hazards a reply tells; none where it tells of no context.
std::optional<HazardTable> from_message(
    const google::protobuf::RepeatedPtrField<v1::HazardCount>& counts, double floor_map_m);

/// Without the stop rule's deadline.
PlanRequest from_message(const v1::PlanRequest& request);
PlanResult from_message(const v1::PlanReply& reply);
PlanStatus from_message(v1::PlanStatus status);

/// T_map_sensor of a view; `mast` turns joints into poses.
Transform from_message(const v1::View& view, const Mast& mast, const std::string& field);

/// The scan of a request, which has at most so many points (rays without a return, pixels).
/// Throws LimitError when it has more.
Scan scan_from_message(const v1::InsertScanRequest& request, std::uint64_t max_points);

v1::Pose to_message(const Transform& T);
v1::JointPosition to_message(const JointPosition& joints);
v1::Search to_message(const Search& search);
v1::ViewGain to_message(const ViewGain& view);
v1::MapFormat to_message(MapFormat format);
v1::PlanStatus to_message(PlanStatus status);
v1::PlanRequest to_message(const PlanRequest& request);
v1::PlanReply to_message(const PlanResult& result);
v1::PointCloud to_message(const Scan& scan);

/// Adds the contexts of the table, by name.
void add_to(google::protobuf::RepeatedPtrField<v1::HazardCount>& counts,
            const HazardTable& hazards);

}  // namespace nbvopt
