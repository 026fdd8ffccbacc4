// SPDX-License-Identifier: BSD-3-Clause
#include "help/command_table.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <sstream>
#include <utility>

namespace flbc::app {
namespace {

// "a|b|c" says which values there are.
std::vector<std::string> choices_of(const std::string& type) {
  if (type.find('|') == std::string::npos) return {};
  std::vector<std::string> choices;
  std::istringstream words(type);
  for (std::string word; std::getline(words, word, '|');) choices.push_back(word);
  return choices;
}

// The name of a value in the usual form: CLI11 names types.
std::string value_name(const std::string& type) {
  std::string name = type.substr(0, type.find(':'));  // ":POSITIVE" names a check
  if (name.size() > 2 && name.front() == '[' && name.back() == ']') {
    name = name.substr(1, name.size() - 2);
  }
  if (name == "TEXT") return "FILE";
  if (name == "FLOAT" || name == "INT" || name == "UINT") return "N";
  return name;
}

void read_options(const CLI::App& app, std::vector<OptionEntry>& positionals,
                  std::vector<OptionEntry>& options) {
  for (const auto* option : app.get_options()) {
    if (option->get_group().empty()) continue;
    (option->nonpositional() ? options : positionals).push_back(read_option(*option));
  }
}

}  // namespace

OptionEntry read_option(const CLI::Option& option) {
  OptionEntry entry;
  for (const auto& name : option.get_snames()) entry.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) entry.names.push_back("--" + name);
  const bool is_positional = option.nonpositional() == false;
  if (is_positional) {
    entry.value = option.get_name(true);
  } else if (option.get_items_expected_max() > 0) {
    entry.value = value_name(option.get_type_name());
  }
  entry.choices = choices_of(entry.value);
  entry.help = option.get_description();
  entry.group = option.get_group();
  entry.required = option.get_required();
  entry.optional_value = !entry.value.empty() && option.get_expected_min() == 0;
  entry.repeated = option.get_expected_max() > 1;
  return entry;
}

std::string as_sentence(std::string phrase) {
  if (phrase.empty()) return phrase;
  phrase[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(phrase[0])));
  return phrase.back() == '.' ? phrase : phrase + ".";
}

CommandTable read_table(const CLI::App& app) {
  CommandTable table;
  table.help = app.get_description();
  std::vector<OptionEntry> none;
  read_options(app, none, table.options);
  for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandEntry entry{command->get_name(), command->get_description(), command->get_footer()};
    read_options(*command, entry.positionals, entry.options);
    table.commands.push_back(std::move(entry));
  }
  return table;
}

}  // namespace flbc::app
