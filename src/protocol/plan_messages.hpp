// Between messages that ask for plans or answer them and the library's own types, both ways.
//
// What comes from a message is checked: a needed field that is not set, a number that is not finite
// and records that are cut short are refused with an InputError that names the field.
#pragma once

#include <optional>
#include <string>

#include "nbvopt/planner/plan.hpp"
#include "nbvopt/sensor/gain_choice.hpp"
#include "nbvopt/solver/search.hpp"
#include "nbvopt/v1/planner.pb.h"

namespace nbvopt {

Search from_message(const v1::Search& search);
ViewGain from_message(const v1::ViewGain& view);

/// A gain's name, or a sum of gains. Throws InputError, which names `field`, for any other text.
GainChoice gain_from_text(const std::string& text, const std::string& field);

/// What hazards a reply tells; none where it tells of no context.
std::optional<HazardTable> from_message(
    const google::protobuf::RepeatedPtrField<v1::HazardCount>& counts, double floor_map_m);

/// Without the stop rule's deadline.
PlanRequest from_message(const v1::PlanRequest& request);
PlanResult from_message(const v1::PlanReply& reply);
PlanStatus from_message(v1::PlanStatus status);

v1::Search to_message(const Search& search);
v1::ViewGain to_message(const ViewGain& view);
v1::PlanStatus to_message(PlanStatus status);
v1::PlanRequest to_message(const PlanRequest& request);
v1::PlanReply to_message(const PlanResult& result);

/// Adds the contexts of the table, by name.
void add_to(google::protobuf::RepeatedPtrField<v1::HazardCount>& counts,
            const HazardTable& hazards);

}  // namespace nbvopt
