#include "study/spec/spec_block.hpp"

#include <algorithm>
#include <cmath>

#include "fields/keys.hpp"
#include "fields/store.hpp"
#include "fields/yaml.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt::study {
namespace {

/// The key's last part: blocks name their keys in full, files do not.
std::string own_key(const SpecValue& value) {
  return value.key.substr(value.key.find_last_of('.') + 1);
}

}  // namespace

std::string SpecValue::place() const {
  const int line = node.Mark().line + 1;
  return file + ": line " + std::to_string(std::max(line, 1)) + (key.empty() ? "" : ": " + key);
}

void SpecValue::refuse(const std::string& fault) const { throw InputError(place() + " " + fault); }

std::vector<SpecValue> SpecValue::elements() const {
  if (!node.IsSequence()) return {*this};
  if (node.size() == 0) refuse("is empty: the study would have nothing to do");
  std::vector<SpecValue> result;
  for (const YAML::Node& element : node) result.push_back({file, key, element});
  return result;
}

FieldValue SpecValue::finite_scalar() const {
  if (!node.IsScalar()) refuse("must be a single value");
  FieldValue value = field_value(node, place());
  const auto* number = std::get_if<double>(&value);
  if (number != nullptr && !std::isfinite(*number)) refuse("is " + to_text(value) + ", not finite");
  return value;
}

std::string SpecValue::text() const {
  if (!node.IsScalar() || node.Scalar().empty()) refuse("must be a word or a text");
  return node.Scalar();
}

double SpecValue::number() const {
  const FieldValue value = finite_scalar();
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr) {
    refuse("is " + to_text(value) + ", it must be a number");
  }
  return *number;
}

std::int64_t SpecValue::whole_number(std::int64_t least) const {
  const FieldValue value = finite_scalar();
  std::int64_t number = 0;
  if (!store(value, number).empty() || number < least) {
    refuse("is " + to_text(value) + ", it must be a whole number, at least " +
           std::to_string(least));
  }
  return number;
}

SpecBlock::SpecBlock(const SpecValue& value, const std::vector<std::string>& known_keys)
    : self_(value) {
  if (!value.node.IsMap()) value.refuse("must hold lines of the form 'key: value'");
  KeyCheck keys(known_keys);
  for (const auto& entry : value.node) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const std::string line = SpecValue{value.file, "", entry.first}.place();
    keys.take(name, line, line + ": " + name);
    const std::string full = value.key.empty() ? name : value.key + "." + name;
    values_.push_back({value.file, full, entry.second});
    if (entry.second.IsNull()) refuse_missing_value(line + ": " + full);
  }
}

std::optional<SpecValue> SpecBlock::find(const std::string& key) const {
  const auto value = std::ranges::find(values_, key, own_key);
  return value == values_.end() ? std::nullopt : std::optional(*value);
}

SpecValue SpecBlock::require(const std::string& key) const {
  const auto value = find(key);
  if (!value) throw InputError(self_.place() + ": " + key + " is missing");
  return *value;
}

}  // namespace nbvopt::study
