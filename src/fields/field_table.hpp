// Tables of named fields: what files call them, where an object keeps them, and what a reader of
// the file should know, such as units.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "fields/store.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {

/// A named field of an object.
template <class Object>
struct Field {
  std::string_view key;
  std::string_view comment;
  std::optional<FieldValue> (*get)(const Object& object);  ///< none: the field is not set
  /// Writes the value and gives an empty text; or says what the value must be.
  std::string (*set)(Object& object, const FieldValue& value);
};

namespace detail {

template <class Value>
inline constexpr bool kIsOptional = false;
template <class Value>
inline constexpr bool kIsOptional<std::optional<Value>> = true;

/// A step of a path: a member, or an element of a vector.
template <auto Step, class Object>
auto& step(Object& object) {
  if constexpr (std::is_member_object_pointer_v<decltype(Step)>) {
    return object.*Step;
  } else {
    return object.at(Step);
  }
}

template <class Object, auto Step, auto... Rest>
std::optional<FieldValue> get(const Object& object) {
  const auto& member = step<Step>(object);
  using Member = std::remove_cvref_t<decltype(member)>;
  if constexpr (sizeof...(Rest) == 0) {
    return value_of(member);
  } else if constexpr (kIsOptional<Member>) {
    using Value = typename Member::value_type;
    return get<Value, Rest...>(member.value_or(Value{}));
  } else {
    return get<Member, Rest...>(member);
  }
}

template <class Object, auto Step, auto... Rest>
std::string set(Object& object, const FieldValue& value) {
  auto& member = step<Step>(object);
  using Member = std::remove_cvref_t<decltype(member)>;
  if constexpr (sizeof...(Rest) == 0) {
    return store(value, member);
  } else if constexpr (kIsOptional<Member>) {
    if (!member) member.emplace();
    return set<typename Member::value_type, Rest...>(*member, value);
  } else {
    return set<Member, Rest...>(member, value);
  }
}

template <class Object, class Member>
Object owner_of(Member Object::*member);

}  // namespace detail

/// The field at the end of a path: pointers to members, and indices where a member is a vector. A
/// part on the way that is optional counts as its default until one of its fields is set.
template <auto Member, auto... Path>
constexpr auto field(std::string_view key, std::string_view comment = {}) {
  using Object = decltype(detail::owner_of(Member));
  return Field<Object>{key, comment, &detail::get<Object, Member, Path...>,
                       &detail::set<Object, Member, Path...>};
}

/// Null for a key that is not in the table.
template <class Object>
const Field<Object>* find_field(std::span<const Field<Object>> fields, std::string_view key) {
  for (const Field<Object>& field : fields) {
    if (field.key == key) return &field;
  }
  return nullptr;
}

template <class Object>
std::vector<std::string> field_keys(std::span<const Field<Object>> fields) {
  std::vector<std::string> keys;
  for (const Field<Object>& field : fields) keys.emplace_back(field.key);
  return keys;
}

/// Writes a field. Throws InputError "<name> is <value>, it must be ..." for a value of a wrong
/// type; `name` stands for the field in the message.
template <class Object>
void set_field(Object& object, const Field<Object>& field, const FieldValue& value,
               const std::string& name) {
  const std::string demand = field.set(object, value);
  if (demand.empty()) return;
  throw InputError(name + " is " + to_text(value) + ", it must be " + demand);
}

}  // namespace nbvopt
