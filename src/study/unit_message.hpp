// A unit of work as the workers' protocol has it (docs/guide/studies.md).
#pragma once

#include <filesystem>
#include <string>

#include "core/json.hpp"
#include "experiment/work.hpp"
#include "study/study.hpp"

namespace nbvopt::study {

enum class WorkKind {
  query,      ///< what a search finds
  reference,  ///< what there is to be found
};

/// All that a worker needs to know.
struct WorkUnit {
  std::string id;  ///< empty on the worker's side
  WorkKind kind = WorkKind::query;
  std::filesystem::path map;
  std::string map_digest;  ///< of the map's content, which must not have changed
  std::filesystem::path robot;
  Start start;
  double motion_time_s = 0.0;
  UncertaintyMode mode = UncertaintyMode::both;
  StudySearch search;  ///< of a query, as the rest below
  Budget budget;
  std::uint64_t seed = 1;
};

Json to_json(const Start& start);
Json to_json(const StudySearch& search);
Json to_json(const Budget& budget);

// The way back. Throw nlohmann's exceptions, and InputError for names that are not known.
Start start_of(const Json& json);
StudySearch search_of(const Json& json);
Budget budget_of(const Json& json);
/// `place` stands for the name in messages.
UncertaintyMode mode_of(const std::string& name, const std::string& place);

experiment::Unit message_of(const WorkUnit& unit);

/// The way back from its payload, which has no id. Throws InputError that says what is wrong.
WorkUnit unit_of(const Json& payload);

}  // namespace nbvopt::study
