#include "cli/describe/command.hpp"

#include <CLI/Option.hpp>
#include <sstream>

namespace nbvopt {
namespace {

void add_commands(const CLI::App& app, const std::string& name, std::vector<Command>& commands) {
  commands.push_back({&app, name});
  for (const CLI::App* sub : subcommands_of(app)) {
    add_commands(*sub, name + " " + sub->get_name(), commands);
  }
}

}  // namespace

std::vector<Command> all_commands(const CLI::App& app) {
  std::vector<Command> commands;
  add_commands(app, app.get_name(), commands);
  return commands;
}

std::vector<const CLI::App*> subcommands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* sub) { return !sub->get_group().empty(); });
}

OptionValue value_of(const CLI::Option& option) {
  OptionValue value;
  if (option.get_items_expected_max() == 0) return value;
  // CLI11 says "NAME:{one,other}", or "NAME:what a check is called".
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  value.name = type.substr(0, colon);
  if (value.name == "TEXT" && option.get_positional()) value.name = option.get_name(true);
  value.is_path = value.name.find("FILE") != std::string::npos || value.name == "PEM" ||
                  value.name == "DIR" || value.name == "OUT.png" || option.get_positional();
  if (colon == std::string::npos || type[colon + 1] != '{') return value;
  std::istringstream words(type.substr(colon + 2, type.find('}', colon) - colon - 2));
  for (std::string word; std::getline(words, word, ',');) value.choices.push_back(word);
  return value;
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

}  // namespace nbvopt
