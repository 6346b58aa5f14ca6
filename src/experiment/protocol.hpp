// The lines that coordinator and workers exchange (docs/guide/studies.md, 'The workers' protocol'),
// without their ends.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiment/work.hpp"

namespace nbvopt::experiment {

/// The version of the protocol that workers say hello with.
inline constexpr int kProtocolVersion = 1;

std::string hello_line();
bool is_hello(std::string_view line);

std::string unit_line(const Unit& unit);

/// Throws InputError that says why the line is no unit.
Unit parse_unit(std::string_view line);

std::string answer_line(const std::string& unit_id, const Outcome& outcome);

/// How a unit ended that a worker was given.
struct AnsweredUnit {
  std::string id;
  Outcome outcome;
};

/// None when the line is no answer.
std::optional<AnsweredUnit> parse_answer(std::string_view line);

}  // namespace nbvopt::experiment
