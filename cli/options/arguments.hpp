// Options with numbers, read strictly: what is not exactly a number is refused by name.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace nbvopt {

/// The finite number that the text is. Throws UsageError when it is not a number, InputError when
/// it is not finite; both name option and text.
double number_argument(const std::string& option, const std::string& text);

/// The finite numbers of a list with commas. Throws as above, and UsageError with `form`, such as
/// "X,Y,YAW", when there are not as many as one of `counts`.
std::vector<double> numbers_argument(const std::string& option, const std::string& text,
                                     std::initializer_list<std::size_t> counts, const char* form);

/// Adds an option that takes one finite number; its help shows `unit` and the default that
/// `target` holds.
CLI::Option* add_number(CLI::App& app, const std::string& name, double& target, const char* unit,
                        const std::string& description);

/// The same for a number whose default the description tells.
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<double>& target,
                        const char* unit, const std::string& description);

/// The same for a whole number from `min` to `max`.
CLI::Option* add_whole_number(CLI::App& app, const std::string& name, std::int64_t& target,
                              std::int64_t min, std::int64_t max, const std::string& description);

/// Adds an option that takes a file of one end of a secured connection.
CLI::Option* add_pem(CLI::App& app, const std::string& name, std::filesystem::path& file,
                     const std::string& description);

}  // namespace nbvopt
