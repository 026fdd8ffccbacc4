// SPDX-License-Identifier: BSD-3-Clause
#include "help/command_table.h"

#include <sstream>

namespace flbc::app {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string names_of_commands(const CommandTable& table) {
  std::vector<std::string> names;
  for (const auto& command : table.commands) names.push_back(command.name);
  return joined(names, " ");
}

std::string names_of_options(const std::vector<OptionEntry>& options) {
  std::vector<std::string> names;
  for (const auto& option : options) {
    names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return joined(names, " ");
}

// Values of an option of a command, if the shell knows them: "command:--option") values.
void add_values(std::ostream& script, const std::string& command, const OptionEntry& option) {
  if (option.value.empty()) return;
  const auto prefix = command + ":";
  std::vector<std::string> patterns;
  for (const auto& name : option.names) patterns.push_back(prefix + name);
  script << "    " << joined(patterns, "|") << ") values=\"" << joined(option.choices, " ")
         << "\" ;;\n";
}

// Between single quotes of a specification of _arguments.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    if (letter == '\'') {
      result += "'\\''";
    } else if (letter == '[' || letter == ']' || letter == ':' || letter == '\\') {
      result += std::string("\\") + letter;
    } else {
      result += letter == '\n' ? ' ' : letter;
    }
  }
  return result;
}

// The action of zsh for a value.
std::string action_of(const OptionEntry& option) {
  if (!option.choices.empty()) return "(" + joined(option.choices, " ") + ")";
  return option.value == "N" ? " " : "_files";
}

// The specification of an option for _arguments.
void add_option(std::ostream& script, const OptionEntry& option) {
  for (const auto& name : option.names) {
    script << " \\\n        '(" << joined(option.names, " ") << ")";
    script << name << "[" << quoted(option.help) << "]";
    if (!option.value.empty()) {
      script << (option.optional_value ? "::" : ":") << quoted(option.value) << ":"
             << action_of(option);
    }
    script << "'";
  }
}

// The actions of zsh for the arguments of a command.
std::string arguments_of(const CommandTable& table, const CommandEntry& command) {
  if (command.name == "completion") return "(bash zsh)";
  return command.name == "man" ? "(" + names_of_commands(table) + ")" : "_files";
}

}  // namespace

std::string bash_completion(const CommandTable& table) {
  std::ostringstream script;
  script
      << "# Made by `flbc completion bash`.\n"
         "_flbc() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}\n"
         "  local values= options= previous=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  COMPREPLY=()\n"
         "  if [[ $COMP_CWORD -eq 1 ]]; then\n"
         "    COMPREPLY=($(compgen -W '"
      << names_of_commands(table) << ' ' << names_of_options(table.options)
      << "' -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  # An option that takes a value: nothing to offer but files if it is not one of a few.\n"
         "  values=none\n"
         "  case $command:$previous in\n";
  for (const auto& command : table.commands) {
    for (const auto& option : command.options) add_values(script, command.name, option);
  }
  script << "  esac\n"
            "  if [[ $values != none && $current != -* ]]; then\n"
            "    [[ -z $values ]] || COMPREPLY=($(compgen -W \"$values\" -- \"$current\"))\n"
            "    return\n"
            "  fi\n"
            "  if [[ $current != -* ]]; then  # a file, but for these\n"
            "    case $command in\n"
            "      completion) values='bash zsh' ;;\n"
            "      man) values='"
         << names_of_commands(table)
         << "' ;;\n"
            "      *) return ;;\n"
            "    esac\n"
            "    COMPREPLY=($(compgen -W \"$values\" -- \"$current\"))\n"
            "    return\n"
            "  fi\n"
            "  case $command in\n";
  for (const auto& command : table.commands) {
    script << "    " << command.name << ") options='" << names_of_options(command.options)
           << "' ;;\n";
  }
  script << "  esac\n"
            "  COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
            "}\n"
            "complete -o default -F _flbc flbc\n";
  return script.str();
}

std::string zsh_completion(const CommandTable& table) {
  std::ostringstream script;
  script << "#compdef flbc\n# Made by `flbc completion zsh`.\n"
            "_flbc() {\n"
            "  local curcontext=$curcontext state line\n"
            "  typeset -A opt_args\n"
            "  _arguments -C";
  for (const auto& option : table.options) add_option(script, option);
  script << " \\\n        '1:command:->command' '*::argument:->argument' && return\n"
            "  case $state in\n"
            "    command)\n"
            "      local -a commands=(\n";
  for (const auto& command : table.commands) {
    script << "        '" << command.name << ":" << quoted(command.help) << "'\n";
  }
  script << "      )\n"
            "      _describe -t commands command commands ;;\n"
            "    argument)\n"
            "      case $words[1] in\n";
  for (const auto& command : table.commands) {
    script << "      " << command.name << ")\n      _arguments -S";
    for (const auto& option : command.options) add_option(script, option);
    script << " \\\n        '*:file:" << arguments_of(table, command) << "' ;;\n";
  }
  script << "      esac ;;\n"
            "  esac\n"
            "}\n"
            "_flbc \"$@\"\n";
  return script.str();
}

}  // namespace flbc::app
