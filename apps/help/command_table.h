// SPDX-License-Identifier: BSD-3-Clause
// The program's commands and options as a table: manual pages and completion are made of it, so
// that they cannot differ from it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace flbc::app {

struct OptionEntry {
  std::vector<std::string> names{};    //!< "-o", "--output"; empty for a positional one
  std::string value{};                 //!< name of the value, as "FILE"; empty for a flag
  std::vector<std::string> choices{};  //!< if the value is one of these
  std::string help{};
  std::string group{};  //!< under which --help shows it
  bool required = false;
  bool optional_value = false;  //!< whether the option may come without it
  bool repeated = false;        //!< whether it may have several values
};

struct CommandEntry {
  std::string name{};
  std::string help{};
  std::string footer{};
  std::vector<OptionEntry> positionals{};
  std::vector<OptionEntry> options{};
};

struct CommandTable {
  std::string help{};
  std::vector<OptionEntry> options{};
  std::vector<CommandEntry> commands{};
};

OptionEntry read_option(const CLI::Option& option);

//! A phrase such as "compute the coordinates of a cage" with a capital letter and a period.
std::string as_sentence(std::string phrase);

//! Reads the parser. Hidden options are left out.
CommandTable read_table(const CLI::App& app);

// Scripts by which shells complete commands, options, and their values.
std::string bash_completion(const CommandTable& table);
std::string zsh_completion(const CommandTable& table);

//! flbc(1), for man.
std::string manual_of_program(const CommandTable& table);

//! flbc-COMMAND(1), for man.
std::string manual_of_command(const CommandEntry& command);

// The same in Markdown, for the site.
std::string markdown_of_program(const CommandTable& table);
std::string markdown_of_command(const CommandEntry& command);

}  // namespace flbc::app
