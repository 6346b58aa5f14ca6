// A block of a spec, whose faults are told with file, line and key.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

#include "nbvopt/fields/field_value.hpp"

namespace nbvopt::study {

/// A node of the spec and how messages name it.
struct SpecValue {
  std::string file;
  std::string key;  ///< such as "starts.sampled.count"
  YAML::Node node;

  /// "spec.yaml: line 7: <key>".
  std::string place() const;

  /// Throws InputError "<place> <fault>".
  [[noreturn]] void refuse(const std::string& fault) const;

  /// The elements of a list, or the value alone. Refuses an empty list.
  std::vector<SpecValue> elements() const;

  /// A scalar, refused when it is none or of another type.
  std::string text() const;
  double number() const;
  std::int64_t whole_number(std::int64_t least) const;
  FieldValue finite_scalar() const;
};

/// The lines "key: value" of a map.
class SpecBlock {
 public:
  /// Refuses what is not a map, a key that is none of these, and one that is given twice.
  SpecBlock(const SpecValue& value, const std::vector<std::string>& known_keys);

  std::optional<SpecValue> find(const std::string& key) const;

  /// Refuses a block without the key.
  SpecValue require(const std::string& key) const;

 private:
  SpecValue self_;
  std::vector<SpecValue> values_;
};

}  // namespace nbvopt::study
