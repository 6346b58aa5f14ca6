#include "experiment/protocol.hpp"

#include <utility>

#include "nbvopt/core/error.hpp"
#include "nbvopt/core/version.hpp"

namespace nbvopt::experiment {
namespace {

/// An object, or null.
Json parse_object(std::string_view line) {
  Json json = Json::parse(line, nullptr, false);
  return json.is_object() ? json : Json();
}

std::string to_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string hello_line() {
  return to_line({{"protocol", kProtocolVersion}, {"nbvopt", version()}});
}

bool is_hello(std::string_view line) {
  const Json hello = parse_object(line);
  return !hello.is_null() && hello.value("protocol", Json()) == kProtocolVersion;
}

std::string unit_line(const Unit& unit) {
  Json line{{"unit", unit.id}};
  line.update(unit.payload);
  return to_line(line);
}

Unit parse_unit(std::string_view line) {
  try {
    Json payload = Json::parse(line);
    std::string id = payload.at("unit").get<std::string>();
    payload.erase("unit");
    return {std::move(id), std::move(payload)};
  } catch (const Json::exception& error) {
    throw InputError(std::string("unit: ") + error.what());
  }
}

std::string answer_line(const std::string& unit_id, const Outcome& outcome) {
  Json line{{"unit", unit_id}};
  if (outcome.failure.empty()) {
    line["answer"] = outcome.answer;
  } else {
    line["failure"] = outcome.failure;
  }
  line["busy_ms"] = outcome.busy_ms;
  return to_line(line);
}

std::optional<AnsweredUnit> parse_answer(std::string_view line) {
  Json said = parse_object(line);
  if (said.is_null()) return std::nullopt;
  const Json id = said.value("unit", Json());
  const Json busy_ms = said.value("busy_ms", Json());
  if (!id.is_string() || !busy_ms.is_number()) return std::nullopt;
  AnsweredUnit unit{id.get<std::string>(), {.answer = Json(), .busy_ms = busy_ms.get<double>()}};
  const Json failure = said.value("failure", Json());
  if (said.contains("answer")) unit.outcome.answer = std::move(said.at("answer"));
  if (unit.outcome.answer.is_object() && failure.is_null()) return unit;
  if (!unit.outcome.answer.is_null() || !failure.is_string()) return std::nullopt;
  unit.outcome.failure = failure.get<std::string>();
  return unit.outcome.failure.empty() ? std::nullopt : std::optional(unit);
}

}  // namespace nbvopt::experiment
