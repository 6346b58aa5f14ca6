// Values of files on their way into typed fields.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "nbvopt/planner/robot_fields.hpp"

namespace nbvopt {

/// The value as messages show it.
std::string to_text(const FieldValue& value);

// store() writes the value into the field and gives an empty text; where it cannot, it leaves the
// field alone and says what the value must be, such as "a whole number".

std::string store(const FieldValue& value, bool& field);
std::string store(const FieldValue& value, double& field);
std::string store(const FieldValue& value, int& field);
std::string store(const FieldValue& value, std::int64_t& field);
std::string store(const FieldValue& value, std::string& field);
std::string store(const FieldValue& value, Eigen::Vector3d& field);

}  // namespace nbvopt
