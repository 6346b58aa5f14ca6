#include "cli/describe/man_page.hpp"

#include <CLI/Option.hpp>
#include <algorithm>
#include <cctype>
#include <sstream>

namespace nbvopt {
namespace {

/// Text that roff shows as it is: its escape character, hyphens that are minus signs, and lines
/// that would be requests.
std::string escaped(const std::string& text) {
  std::string result;
  bool starts_line = true;
  for (const char c : text) {
    if (starts_line && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
    starts_line = c == '\n';
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string paragraph(const std::string& tag, const std::string& text) {
  return ".TP\n" + tag + "\n" + escaped(text) + "\n";
}

std::string option_text(const CLI::Option& option) {
  std::string tag;
  for (const std::string& name : names_of(option)) tag += (tag.empty() ? "" : ", ") + bold(name);
  const OptionValue value = value_of(option);
  if (!value.name.empty()) tag += (tag.empty() ? "" : " ") + italic(value.name);

  std::string text = option.get_description();
  if (!value.choices.empty()) text += ". One of " + joined(value.choices, ", ");
  const std::string preset = option.get_default_str();
  if (!preset.empty()) text += ". Default: " + preset;
  if (option.get_required()) text += ". Required";
  for (const CLI::Option* needed : option.get_needs()) text += ". Needs " + needed->get_name();
  return paragraph(tag, text + ".");
}

/// The groups of options in the order of the help.
std::string options_text(const CLI::App& app) {
  std::string text;
  const auto add = [&](const std::string& title, const auto& filter) {
    const std::vector<const CLI::Option*> options = app.get_options(filter);
    if (options.empty()) return;
    text += ".SH \"" + escaped(upper(title)) + "\"\n";
    for (const CLI::Option* option : options) text += option_text(*option);
  };
  add("Arguments", [](const CLI::Option* option) { return names_of(*option).empty(); });
  for (const std::string& group : app.get_groups()) {
    if (group.empty()) continue;  // hidden
    add(group, [&](const CLI::Option* option) {
      return option->get_group() == group && !names_of(*option).empty();
    });
  }
  return text;
}

std::string synopsis(const Command& command) {
  std::string text = bold(command.name) + " [" + italic("OPTIONS") + "]";
  if (!subcommands_of(*command.app).empty()) return text + " " + italic("SUBCOMMAND");
  const auto is_argument = [](const CLI::Option* option) { return names_of(*option).empty(); };
  for (const CLI::Option* argument : command.app->get_options(is_argument)) {
    const std::string name = italic(argument->get_name(true));
    text += argument->get_required() ? " " + name : " [" + name + "]";
  }
  return text;
}

}  // namespace

std::string page_name(const Command& command) {
  std::string name = command.name;
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string man_page(const Command& command, const std::string& version) {
  const CLI::App& app = *command.app;
  const std::string name = page_name(command);
  std::string text = ".TH \"" + escaped(upper(name)) + "\" \"1\" \"\" \"nbvopt " +
                     escaped(version) + "\" \"nbvopt\"\n";
  text += ".SH NAME\n" + escaped(name) + " \\- " + escaped(app.get_description()) + "\n";
  text += ".SH SYNOPSIS\n" + synopsis(command) + "\n";
  text += options_text(app);
  const std::vector<const CLI::App*> subcommands = subcommands_of(app);
  if (!subcommands.empty()) {
    text += ".SH SUBCOMMANDS\n";
    for (const CLI::App* sub : subcommands) {
      text += paragraph(bold(name + "-" + sub->get_name()) + "(1)", sub->get_description());
    }
  }
  if (!app.get_footer().empty()) text += ".SH NOTES\n.nf\n" + escaped(app.get_footer()) + "\n.fi\n";
  const std::size_t parent = name.rfind('-');
  if (parent != std::string::npos) {
    text += ".SH \"SEE ALSO\"\n" + bold(name.substr(0, parent)) + "(1)\n";
  }
  return text;
}

}  // namespace nbvopt
