// SPDX-License-Identifier: BSD-3-Clause
// flbc man: manual pages, and the same as Markdown.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "files/load.h"
#include "flbc/errors.h"
#include "flbc/io/files.h"
#include "help/command_table.h"

namespace flbc::app {
namespace {

std::string page_of(const CommandTable& table, const std::string& name) {
  if (name.empty()) return manual_of_program(table);
  for (const auto& command : table.commands) {
    if (command.name == name) return manual_of_command(command);
  }
  throw OptionError("unknown command '" + name + "'; see flbc --help");
}

// Under the names by which they are installed.
void write_all(const CommandTable& table, const std::string& folder) {
  make_folder(folder);
  const auto put = [&](const std::string& name, const std::string& text) {
    io::write_file(folder + "/" + name, [&](std::ostream& file) { file << text; });
  };
  put("flbc.1", manual_of_program(table));
  put("index.md", markdown_of_program(table));
  for (const auto& command : table.commands) {
    put("flbc-" + command.name + ".1", manual_of_command(command));
    put(command.name + ".md", markdown_of_command(command));
  }
  put("flbc.bash", bash_completion(table));
  put("_flbc", zsh_completion(table));
}

struct ManArguments {
  std::string command;
  std::string folder;
};

}  // namespace

void add_man_command(CLI::App& app, int&) {
  auto arguments = std::make_shared<ManArguments>();
  auto* command = app.add_subcommand("man", "print a manual page");
  command->footer("Example: flbc man solve | man -l -");
  auto* name =
      command
          ->add_option("COMMAND", arguments->command, "command to describe (default: the program)")
          ->type_name("COMMAND");
  command
      ->add_option(
          "--folder", arguments->folder,
          "write all pages, as manual pages and as Markdown, and the completion scripts to this "
          "folder")
      ->excludes(name);
  command->callback([&app, arguments] {
    const auto table = read_table(app);
    if (arguments->folder.empty()) {
      std::cout << page_of(table, arguments->command);
    } else {
      write_all(table, arguments->folder);
    }
  });
}

}  // namespace flbc::app
