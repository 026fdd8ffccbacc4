// SPDX-License-Identifier: BSD-3-Clause
// flbc completion: what makes shells complete commands and options.
#include <iostream>
#include <memory>

#include "commands/commands.h"
#include "help/command_table.h"

namespace flbc::app {

void add_completion_command(CLI::App& app, int&) {
  auto shell = std::make_shared<std::string>();
  auto* command = app.add_subcommand("completion", "print a shell completion script");
  command->footer(
      "For this session: source <(flbc completion bash). An installation contains the scripts as\n"
      "share/bash-completion/completions/flbc and share/zsh/site-functions/_flbc.");
  command->add_option("SHELL", *shell, "shell: bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  command->callback([&app, shell] {
    const auto table = read_table(app);
    std::cout << (*shell == "bash" ? bash_completion(table) : zsh_completion(table));
  });
}

}  // namespace flbc::app
