#include "cli/options/arguments.hpp"

// Whole, since the parts that others include leave functions of CLI11 without a home.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/number.hpp"
#include "nbvopt/core/error.hpp"

namespace nbvopt {
namespace {

std::int64_t whole_number_argument(const std::string& option, const std::string& text,
                                   std::int64_t min, std::int64_t max) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [read_end, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument || read_end != end) {
    throw UsageError(option + ": '" + text + "' is not a whole number");
  }
  if (error == std::errc::result_out_of_range || value < min || value > max) {
    throw InputError(option + " is " + text + ", it must be from " + std::to_string(min) + " to " +
                     std::to_string(max));
  }
  return value;
}

template <class Target>
CLI::Option* add_number_into(CLI::App& app, const std::string& name, Target& target,
                             const char* unit, const std::string& description) {
  return app
      .add_option_function<std::string>(
          name, [name, &target](const std::string& text) { target = number_argument(name, text); },
          description)
      ->type_name(unit);
}

}  // namespace

double number_argument(const std::string& option, const std::string& text) {
  const auto value = parse_number(text);
  if (!value) throw UsageError(option + ": '" + text + "' is not a number");
  if (!std::isfinite(*value)) throw InputError(option + " is " + text + ", it must be finite");
  return *value;
}

std::vector<double> numbers_argument(const std::string& option, const std::string& text,
                                     std::initializer_list<std::size_t> counts, const char* form) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(number_argument(option, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) {
    throw UsageError(option + ": '" + text + "' has " + std::to_string(numbers.size()) +
                     " numbers, write " + form);
  }
  return numbers;
}

CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const char* unit,
                        const std::string& description) {
  return add_number_into(app, name, target, unit, description)->default_str(format_number(target));
}

CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& target,
                        const char* unit, const std::string& description) {
  return add_number_into(app, name, target, unit, description);
}

CLI::Option* add_whole_number(CLI::App& app, const std::string& name, std::int64_t& target,
                              std::int64_t min, std::int64_t max, const std::string& description) {
  return app
      .add_option_function<std::string>(
          name,
          [name, &target, min, max](const std::string& text) {
            target = whole_number_argument(name, text, min, max);
          },
          description)
      ->type_name("N")
      ->default_str(std::to_string(target));
}

CLI::Option* add_pem(CLI::App& app, const std::string& name, std::filesystem::path& file,
                     const std::string& description) {
  return app.add_option(name, file, description)->type_name("PEM");
}

}  // namespace nbvopt
