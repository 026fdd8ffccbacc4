// SPDX-License-Identifier: BSD-3-Clause
// The manual as Markdown, for the site.
#include <algorithm>
#include <iterator>
#include <regex>
#include <sstream>

#include "help/command_table.h"

namespace flbc::app {
namespace {

// Options, extensions and names of files as code, and no cell of a table that ends early.
std::string in_cell(const std::string& text) {
  static const std::regex kCode(
      R"((^|[ (])(--?[a-z][a-z-]*|\.[a-z]{2,4}\b|[A-Za-z]*[_%][\w%.]*\w))");
  static const std::regex kBar(R"(\|)");
  return std::regex_replace(std::regex_replace(text, kCode, "$1`$2`"), kBar, "\\|");
}

// "--output FILE"
std::string with_value(const std::string& name, const OptionEntry& option) {
  if (option.value.empty()) return name;
  const auto value = (option.choices.empty() ? option.value : "VALUE") +
                     std::string(option.repeated && !option.optional_value ? " ..." : "");
  return name + " " + (option.optional_value ? "[" + value + "]" : value);
}

std::string name_cell(const OptionEntry& option) {
  if (option.names.empty()) return "`" + option.value + "`";
  std::string text;
  for (std::size_t k = 0; k + 1 < option.names.size(); ++k) text += "`" + option.names[k] + "`, ";
  return text + "`" + with_value(option.names.back(), option) + "`";
}

std::string help_of(const OptionEntry& option) {
  auto text = in_cell(option.help);
  for (std::size_t k = 0; k < option.choices.size(); ++k) {
    text += (k == 0 ? "; values: `" : ", `") + option.choices[k] + "`";
  }
  return text + (option.required && !option.names.empty() ? " (required)" : "");
}

void add_table(std::ostream& page, const std::string& title,
               const std::vector<OptionEntry>& entries) {
  if (entries.empty()) return;
  page << "\n## " << title << "\n\n| Name | Meaning |\n|---|---|\n";
  for (const auto& entry : entries) {
    page << "| " << name_cell(entry) << " | " << help_of(entry) << " |\n";
  }
}

std::string synopsis_of(const CommandEntry& command) {
  auto text = "flbc " + command.name;
  for (const auto& positional : command.positionals) {
    const auto value = positional.value + (positional.repeated ? " ..." : "");
    text += positional.required ? " " + value : " [" + value + "]";
  }
  for (const auto& option : command.options) {
    if (option.required) text += " " + with_value(option.names.back(), option);
  }
  return text + " [OPTIONS]";
}

// In the order of their first options.
std::vector<std::string> groups_of(const std::vector<OptionEntry>& options) {
  std::vector<std::string> groups;
  for (const auto& option : options) {
    if (std::find(groups.begin(), groups.end(), option.group) == groups.end()) {
      groups.push_back(option.group);
    }
  }
  return groups;
}

}  // namespace

std::string markdown_of_program(const CommandTable& table) {
  std::ostringstream page;
  page << "# Commands\n\nThe program `flbc` has these commands. `flbc COMMAND --help` prints the "
          "options of a command.\n\n| Command | Purpose |\n|---|---|\n";
  for (const auto& command : table.commands) {
    page << "| [`flbc " << command.name << "`](" << command.name << ".md) | "
         << in_cell(command.help) << " |\n";
  }
  page << "\nAll commands use the same [exit status](../exit_status.md).\n";
  return page.str();
}

std::string markdown_of_command(const CommandEntry& command) {
  std::ostringstream page;
  page << "# flbc " << command.name << "\n\n"
       << as_sentence(command.help) << "\n\n```\n"
       << synopsis_of(command) << "\n```\n";
  if (!command.footer.empty()) page << '\n' << command.footer << '\n';
  add_table(page, "Arguments", command.positionals);
  for (const auto& group : groups_of(command.options)) {
    std::vector<OptionEntry> entries;
    std::copy_if(command.options.begin(), command.options.end(), std::back_inserter(entries),
                 [&](const auto& option) { return option.group == group; });
    add_table(page, group, entries);
  }
  page << "\nSee also: [exit status](../exit_status.md), [all commands](index.md).\n";
  return page.str();
}

}  // namespace flbc::app
