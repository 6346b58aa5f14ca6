#include <CLI/Option.hpp>
#include <map>

#include "cli/describe/command.hpp"
#include "cli/describe/completion.hpp"

namespace nbvopt {
namespace {

// The line is split here, not by bash, which would break values such as nlopt:lbfgs at the colon;
// what stands before a colon is then taken off again, since bash replaces only what stands behind.
constexpr const char* kScript = R"(# Completes PROGRAM; made from its own description.
_PROGRAM_words() {
  local kept=${cur%"${cur##*:}"}
  COMPREPLY=($(compgen -W "$1" -- "$cur"))
  COMPREPLY=("${COMPREPLY[@]#"$kept"}")
}

_PROGRAM() {
  local line=${COMP_LINE:0:COMP_POINT} command=PROGRAM word cur prev=
  local -a words
  read -ra words <<< "$line"
  [[ $line == *[[:space:]] ]] && words+=('')
  cur=${words[-1]}
  ((${#words[@]} > 2)) && prev=${words[-2]}
  for word in "${words[@]:1:${#words[@]}-2}"; do
    case "$command $word" in
COMMANDS    esac
  done
  if [[ $cur == --*=* ]]; then
    prev=${cur%%=*}
    cur=${cur#*=}
  fi
  COMPREPLY=()
  case "$command $prev" in
VALUES  esac
  if [[ $cur == -* ]]; then
    case $command in
OPTIONS    esac
    return
  fi
  case $command in
SUBCOMMANDS    *) compopt -o default ;;
  esac
}
complete -F _PROGRAM PROGRAM
)";

void replace_all(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t i = text.find(what); i != std::string::npos;
       i = text.find(what, i + with.size())) {
    text.replace(i, what.size(), with);
  }
}

std::string any_of(const std::vector<std::string>& patterns) {
  std::vector<std::string> quoted;
  for (const std::string& pattern : patterns) quoted.push_back("'" + pattern + "'");
  return joined(quoted, " | ");
}

std::string words_case(const std::string& pattern, const std::vector<std::string>& words) {
  return "    " + pattern + ") _PROGRAM_words '" + joined(words, " ") + "' ;;\n";
}

}  // namespace

std::string bash_completion(const CLI::App& app) {
  std::string commands;
  std::string values;
  std::string options;
  std::string subcommands;
  for (const Command& command : all_commands(app)) {
    std::vector<std::string> names;
    for (const CLI::App* sub : subcommands_of(*command.app)) names.push_back(sub->get_name());
    if (!names.empty()) subcommands += words_case("'" + command.name + "'", names);
    if (command.app != &app) commands += "      '" + command.name + "') command+=\" $word\" ;;\n";

    std::vector<std::string> all;
    for (const CLI::Option* option : command.app->get_options()) {
      std::vector<std::string> patterns;
      for (const std::string& name : names_of(*option)) {
        all.push_back(name);
        patterns.push_back(command.name + " " + name);
      }
      const OptionValue value = value_of(*option);
      if (patterns.empty() || value.name.empty()) continue;
      values += "    " + any_of(patterns) + ") ";
      if (value.is_path) {
        values += "compopt -o default; return ;;\n";
      } else if (value.choices.empty()) {
        values += "return ;;\n";
      } else {
        values += "_PROGRAM_words '" + joined(value.choices, " ") + "'; return ;;\n";
      }
    }
    options += words_case("'" + command.name + "'", all);
  }
  std::string script = kScript;
  replace_all(script, "SUBCOMMANDS", subcommands);
  replace_all(script, "COMMANDS", commands);
  replace_all(script, "VALUES", values);
  replace_all(script, "OPTIONS", options);
  replace_all(script, "PROGRAM", app.get_name());
  return script;
}

}  // namespace nbvopt
