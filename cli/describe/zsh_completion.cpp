#include <CLI/Option.hpp>

#include "cli/describe/command.hpp"
#include "cli/describe/completion.hpp"

namespace nbvopt {
namespace {

/// Text within '...', for _arguments, which gives colons and brackets a meaning.
std::string escaped_for_arguments(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == ':' || c == '[' || c == ']' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// ":FILE:_files", ":NAME:(one other)" or ":N: ".
std::string value_spec(const OptionValue& value) {
  if (value.name.empty()) return "";
  std::string spec = ":" + escaped_for_arguments(value.name) + ":";
  if (value.is_path) return spec + "_files";
  if (value.choices.empty()) return spec + " ";
  return spec + "(" + escaped_for_arguments(joined(value.choices, " ")) + ")";
}

std::string specs_of(const CLI::App& app) {
  std::string specs;
  for (const CLI::Option* option : app.get_options()) {
    const OptionValue value = value_of(*option);
    const std::string what = "[" + escaped_for_arguments(option->get_description()) + "]";
    for (const std::string& name : names_of(*option)) {
      specs += " \\\n        '" + name + what + value_spec(value) + "'";
    }
  }
  return specs + " \\\n        '*:file:_files'";
}

/// The list of subcommands for _describe.
std::string described(const CLI::App& app) {
  std::string list;
  for (const CLI::App* sub : subcommands_of(app)) {
    list += " '" + sub->get_name() + ":" + escaped_for_arguments(sub->get_description()) + "'";
  }
  return list;
}

}  // namespace

std::string zsh_completion(const CLI::App& app) {
  const std::string program = app.get_name();
  std::string known;
  std::string cases;
  for (const Command& command : all_commands(app)) {
    if (command.app != &app) known += " '" + command.name + "'";
    cases += "    '" + command.name + "')\n";
    if (!subcommands_of(*command.app).empty()) {
      cases += "      if [[ $words[CURRENT] != -* ]]; then\n        subcommands=(" +
               described(*command.app) +
               " )\n        _describe command subcommands\n        return\n      fi\n";
    }
    cases += "      _arguments -s" + specs_of(*command.app) + " ;;\n";
  }
  return "#compdef " + program + "\n# Completes " + program +
         "; made from its own description.\n"
         "local command=" +
         program +
         "\n"
         "local -a known subcommands\n"
         "known=(" +
         known +
         " )\n"
         "while (( CURRENT > 2 )) && (( ${known[(Ie)$command $words[2]]} )); do\n"
         "  command+=\" $words[2]\"\n"
         "  shift words\n"
         "  (( CURRENT-- ))\n"
         "done\n"
         "case $command in\n" +
         cases + "esac\n";
}

}  // namespace nbvopt
