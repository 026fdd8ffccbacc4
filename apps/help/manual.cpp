// SPDX-License-Identifier: BSD-3-Clause
#include "help/command_table.h"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <utility>

#include "flbc/version.h"

namespace flbc::app {
namespace {

// Text with the characters escaped that mean something in the language of manual pages.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    const bool begins_line = result.empty() || result.back() == '\n';
    if (begins_line && (letter == '.' || letter == '\'')) result += "\\&";
    if (letter == '\\') {
      result += "\\e";
    } else if (letter == '-') {
      result += "\\-";
    } else {
      result += letter;
    }
  }
  return result;
}

std::string bold(const std::string& text) {
  return "\\fB" + escaped(text) + "\\fR";
}

std::string italic(const std::string& text) {
  return "\\fI" + escaped(text) + "\\fR";
}

std::string header(const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return ".TH \"" + escaped(upper) + "\" 1 \"\" \"flbc " FLBC_VERSION "\" \"libflbc\"\n";
}

// The first sentence as the second half of a NAME.
std::string after_name(std::string help) {
  if (help.empty()) return help;
  help[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[0])));
  help = help.substr(0, help.find('\n'));
  if (help.back() == '.') help.pop_back();
  return help;
}

// The value of an option, as it follows the name.
std::string value_of(const OptionEntry& option) {
  if (option.value.empty()) return "";
  std::string text = option.choices.empty() ? italic(option.value) : bold(option.value);
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 1)) {
    text.insert(at + 1, "\\:");  // lines may break there
  }
  if (option.repeated && !option.optional_value) text += " ...";
  return option.optional_value ? " [" + text + "]" : " " + text;
}

std::string in_synopsis(const OptionEntry& option) {
  const std::string text = bold(option.names.back()) + value_of(option);
  return option.required ? text : "[" + text + "]";
}

// A tag and its explanation.
void add_entry(std::ostream& page, const std::string& tag, const std::string& help) {
  page << ".TP\n" << tag << '\n' << escaped(help) << '\n';
}

void add_options(std::ostream& page, const std::vector<OptionEntry>& options) {
  page << ".SH OPTIONS\n";
  for (const auto& option : options) {
    std::string names;
    for (const auto& name : option.names) names += (names.empty() ? "" : ", ") + bold(name);
    add_entry(page, names + value_of(option), option.help + (option.required ? " (required)" : ""));
  }
}

void add_exit_status(std::ostream& page) {
  constexpr std::pair<const char*, const char*> kStatus[] = {
      {"0", "done"},
      {"1", "wrong usage"},
      {"2", "bad input; the message names the file, the element, and its position"},
      {"3", "not converged within the limits; the results are written"},
      {"4", "a file cannot be read or written"},
      {"5", "out of memory"}};
  page << ".SH EXIT STATUS\n";
  for (const auto& [number, meaning] : kStatus) add_entry(page, bold(number), meaning);
}

}  // namespace

std::string manual_of_program(const CommandTable& table) {
  std::ostringstream page;
  page << header("flbc") << ".SH NAME\nflbc \\- " << escaped(after_name(table.help)) << '\n'
       << ".SH SYNOPSIS\n"
       << bold("flbc") << ' ' << italic("COMMAND") << " ...\n"
       << ".SH DESCRIPTION\n"
       << escaped(table.help.substr(0, table.help.find('\n'))) << '\n'
       << "Each command has a page of its own,\n"
       << bold("flbc-") << italic("COMMAND") << "(1), and\n"
       << bold("--help") << ".\n"
       << ".SH COMMANDS\n";
  for (const auto& command : table.commands) {
    add_entry(page, bold(command.name), as_sentence(command.help));
  }
  add_options(page, table.options);
  add_exit_status(page);
  page << ".SH SEE ALSO\n";
  for (const auto& command : table.commands) {
    page << bold("flbc-" + command.name) << "(1)" << (&command == &table.commands.back() ? "" : ",")
         << '\n';
  }
  return page.str();
}

std::string manual_of_command(const CommandEntry& command) {
  std::ostringstream page;
  const std::string name = "flbc-" + command.name;
  page << header(name) << ".SH NAME\n"
       << escaped(name) << " \\- " << escaped(after_name(command.help)) << '\n'
       << ".SH SYNOPSIS\n.nh\n.ad l\n"
       << bold("flbc " + command.name) << '\n';
  for (const auto& positional : command.positionals) {
    const auto text = italic(positional.value) + (positional.repeated ? " ..." : "");
    page << (positional.required ? text : "[" + text + "]") << '\n';
  }
  for (const auto& option : command.options) page << in_synopsis(option) << '\n';
  page << ".ad b\n.hy\n.SH DESCRIPTION\n" << escaped(as_sentence(command.help)) << '\n';
  if (!command.footer.empty()) page << ".PP\n" << escaped(command.footer) << '\n';
  if (!command.positionals.empty()) page << ".SH ARGUMENTS\n";
  for (const auto& positional : command.positionals) {
    add_entry(page, italic(positional.value), positional.help);
  }
  add_options(page, command.options);
  add_exit_status(page);
  page << ".SH SEE ALSO\n" << bold("flbc") << "(1)\n";
  return page.str();
}

}  // namespace flbc::app
