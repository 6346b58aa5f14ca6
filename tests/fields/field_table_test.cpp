// Named fields: into typed members and back, whatever file they come from.
#include "fields/field_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "fields/json.hpp"
#include "fields/keys.hpp"
#include "fields/yaml.hpp"
#include "support/error_message.hpp"

namespace nbvopt {
namespace {

enum class Shape { round, square };

}  // namespace

template <>
inline constexpr auto kEnumNames<Shape> = std::to_array<EnumName<Shape>>({
    {Shape::round, "round"},
    {Shape::square, "square"},
});

namespace {

using test::message_of;

struct Part {
  int count = 3;
  std::string word = "none";
};

struct Thing {
  bool flag = false;
  double length_m = 1.0;
  Shape shape = Shape::round;
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  std::optional<double> limit_s;
  std::optional<Part> part;
  std::vector<double> steps{0.5, 0.25};
};

constexpr auto kTable = std::to_array<Field<Thing>>({
    field<&Thing::flag>("flag", "true or false"),
    field<&Thing::length_m>("length_m", "m"),
    field<&Thing::shape>("shape"),
    field<&Thing::offset_m>("offset_m"),
    field<&Thing::limit_s>("limit_s"),
    field<&Thing::part, &Part::count>("count"),
    field<&Thing::steps, std::size_t{1}>("second_step"),
});
const std::span<const Field<Thing>> kFields = kTable;

FieldValue get(const Thing& thing, std::string_view key) {
  return find_field(kFields, key)->get(thing).value();
}

TEST(FieldTable, StoresWhatItGivesBack) {
  const std::vector<FieldSetting> given{
      {"flag", true},        {"length_m", 2.5},
      {"shape", "square"},   {"offset_m", std::vector<double>{1.0, 2.0, 3.0}},
      {"limit_s", 0.5},      {"count", 7.0},
      {"second_step", 0.125}};
  Thing thing;
  for (const auto& [key, value] : given) {
    set_field(thing, *find_field(kFields, key), value, key);
    EXPECT_EQ(get(thing, key), value) << key;
  }
  EXPECT_EQ(thing.shape, Shape::square);
  EXPECT_EQ(thing.offset_m, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(thing.part->count, 7);
  EXPECT_EQ(thing.steps, (std::vector<double>{0.5, 0.125}));
}

TEST(FieldTable, TellsWhatIsNotSetFromWhatHasADefault) {
  const Thing thing;
  EXPECT_EQ(find_field(kFields, "limit_s")->get(thing), std::nullopt);
  EXPECT_EQ(get(thing, "count"), FieldValue(3.0)) << "the default of a part that is not there";
  EXPECT_EQ(find_field(kFields, "length"), nullptr);
  EXPECT_EQ(field_keys(kFields).back(), "second_step");
}

TEST(FieldTable, SaysWhatAValueMustBe) {
  Thing thing;
  const auto refusal = [&](std::string_view key, const FieldValue& value) {
    return message_of<InputError>(
        [&] { set_field(thing, *find_field(kFields, key), value, "file: " + std::string(key)); });
  };
  EXPECT_EQ(refusal("flag", 1.0), "file: flag is 1, it must be true or false");
  EXPECT_EQ(refusal("shape", "oval"), "file: shape is 'oval', it must be one of round, square");
  EXPECT_EQ(refusal("shape", 1.0), "file: shape is 1, it must be one of round, square");
  EXPECT_EQ(refusal("count", 1.5), "file: count is 1.5, it must be a whole number");
  EXPECT_EQ(refusal("limit_s", "long"), "file: limit_s is 'long', it must be a number");
  EXPECT_EQ(refusal("offset_m", std::vector<double>{1.0}),
            "file: offset_m is a list of 1 numbers, it must be a list of three numbers");
  EXPECT_EQ(thing.limit_s, std::nullopt) << "left alone";
}

TEST(FieldKeys, AreKnownAndGivenOnce) {
  KeyCheck keys({"width", "height"}, "side");
  keys.take("width", "file", "file.width");
  EXPECT_EQ(message_of<InputError>([&] { keys.take("hight", "file", "file.hight"); }),
            "file: unknown side 'hight', did you mean 'height'?");
  EXPECT_EQ(message_of<InputError>([&] { keys.take("width", "file", "file.width"); }),
            "file.width is given twice, keep one");
}

TEST(FieldJson, KeepsSettings) {
  const std::vector<FieldSetting> settings{{"word", "b"}, {"number", 0.1}, {"flag", false}};
  EXPECT_EQ(settings_of(to_json(settings), "block"), settings);
  EXPECT_EQ(to_json(settings).dump(), R"({"word":"b","number":0.1,"flag":false})");
  EXPECT_EQ(message_of<InputError>([] { settings_of(Json::array({1}), "block"); }),
            "block must be an object {...}");
  EXPECT_EQ(message_of<InputError>([] {
              settings_of({{"key", nullptr}}, "block");
            }),
            "block.key must be a number, a string, true or false");
}

TEST(FieldYaml, TypesScalarsByWhatTheyLookLike) {
  const auto read = [](const std::string& text) {
    return field_value(parse_yaml(text, "file"), "field");
  };
  for (const FieldValue& value : {FieldValue(true), FieldValue(0.1), FieldValue("word"),
                                  FieldValue(std::vector<double>{1.0, -2.5})}) {
    EXPECT_EQ(read(to_yaml(value)), value);
  }
  EXPECT_EQ(read("'4'"), FieldValue("4"));
  EXPECT_EQ(message_of<InputError>([&] { read("~"); }),
            "field has no value, give one or leave the key out");
}

}  // namespace
}  // namespace nbvopt
