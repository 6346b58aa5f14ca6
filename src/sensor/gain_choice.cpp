#include "nbvopt/sensor/gain_choice.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"
#include "sensor/sensor_names.hpp"

namespace nbvopt {
namespace {

bool is_weight(double weight) { return std::isfinite(weight) && weight > 0.0; }

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// "name" or "weight*name"; none where it is neither.
std::optional<GainTerm> parse_term(std::string_view text) {
  GainTerm term;
  std::string_view name = trimmed(text);
  if (const std::size_t star = name.find('*'); star != std::string_view::npos) {
    const std::optional<double> weight = parse_number(trimmed(name.substr(0, star)));
    if (!weight || !is_weight(*weight)) return std::nullopt;
    term.weight = *weight;
    name = trimmed(name.substr(star + 1));
  }
  const std::optional<GainKind> kind = enum_value<GainKind>(name);
  if (!kind) return std::nullopt;
  term.kind = *kind;
  return term;
}

/// Where the first term ends; the plus of an exponent, as in 1e+05, ends none.
std::size_t end_of_term(std::string_view text) {
  std::size_t plus = text.find('+');
  while (plus != std::string_view::npos && plus >= 2 && text[plus - 1] == 'e' &&
         (std::isdigit(static_cast<unsigned char>(text[plus - 2])) != 0 || text[plus - 2] == '.')) {
    plus = text.find('+', plus + 1);
  }
  return plus;
}

std::optional<GainChoice> parse_sum(std::string_view text) {
  std::vector<GainTerm> terms;
  for (;;) {
    const std::size_t plus = end_of_term(text);
    const std::optional<GainTerm> term = parse_term(text.substr(0, plus));
    if (!term) return std::nullopt;
    terms.push_back(*term);
    if (plus == std::string_view::npos) return GainChoice(std::move(terms));
    text.remove_prefix(plus + 1);
  }
}

}  // namespace

GainChoice::GainChoice(std::vector<GainTerm> terms) : terms_(std::move(terms)) {
  if (terms_.empty()) throw UsageError("a sum of gains has no term: name a gain");
  for (const GainTerm& term : terms_) {
    if (is_weight(term.weight)) continue;
    throw UsageError("the weight of gain " + std::string(enum_name(term.kind)) + " is " +
                     format_number(term.weight) + ", it must be finite and greater than 0");
  }
}

bool GainChoice::has(GainKind kind) const {
  return std::ranges::find(terms_, kind, &GainTerm::kind) != terms_.end();
}

std::string to_string(const GainChoice& value) {
  std::string text;
  for (const GainTerm& term : value.terms()) {
    if (!text.empty()) text += " + ";
    if (term.weight != 1.0) text += format_number(term.weight) + "*";
    text += enum_name(term.kind);
  }
  return text;
}

std::vector<std::string> gain_names() { return enum_names<GainKind>(); }

std::string store(const FieldValue& value, GainChoice& field) {
  const auto* text = std::get_if<std::string>(&value);
  if (const auto choice = text ? parse_sum(*text) : std::nullopt) {
    field = *choice;
    return {};
  }
  std::string demand = "a gain or a sum such as positive + 0.5*rear_side_voxel, the gains being ";
  const std::vector<std::string> names = gain_names();
  for (const std::string& name : names) demand += (&name == &names.front() ? "" : ", ") + name;
  return demand;
}

}  // namespace nbvopt
