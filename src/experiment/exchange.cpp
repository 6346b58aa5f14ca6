#include "experiment/exchange.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>

#include "experiment/protocol.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::experiment {

void list_units(Work& work, std::span<const std::size_t> to_do, double timeout_s,
                const std::function<void(const std::string& line)>& visit) {
  for (const std::size_t index : to_do) {
    const UnitFiles files = work.files(index);
    Json engine{{"timeout_s", timeout_s}, {"reads", files.reads}, {"writes", files.writes}};
    const std::optional<std::size_t> before = work.predecessor(index);
    if (before && std::ranges::binary_search(to_do, *before)) engine["after"] = work.id(*before);
    Unit unit = work.unit(index);
    unit.payload["engine"] = std::move(engine);
    visit(unit_line(unit));
  }
}

void record_answers(Work& work, std::vector<bool> has_answer, RecordFile& records,
                    std::istream& answers,
                    const std::function<void(const std::string& id)>& on_kept) {
  std::unordered_map<std::string, std::size_t> unit_of_id;
  for (std::size_t i = 0; i < has_answer.size(); ++i) unit_of_id.emplace(work.id(i), i);
  std::string line;
  for (std::size_t number = 1; std::getline(answers, line); ++number) {
    const std::optional<AnsweredUnit> answered = parse_answer(line);
    const auto unit = answered ? unit_of_id.find(answered->id) : unit_of_id.end();
    if (unit == unit_of_id.end()) {
      throw InputError("answers: line " + std::to_string(number) +
                       ": is no answer to a unit of this experiment: " + line.substr(0, 80));
    }
    if (!has_answer[unit->second]) {
      records.append(work.record(unit->second, answered->outcome));
      has_answer[unit->second] = answered->outcome.failure.empty();
    }
    on_kept(answered->id);
  }
}

}  // namespace nbvopt::experiment
