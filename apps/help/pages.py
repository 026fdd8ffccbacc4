#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""pages.py FOLDER PROGRAM...: manual pages, completion scripts, and pages of the site, made of --help."""
import collections
import pathlib
import re
import subprocess
import sys

Entry = collections.namedtuple("Entry", "names value choices optional repeated required help group")
Command = collections.namedtuple("Command", "name help footer arguments options")
COLUMN = 30  # where explanations begin
STATUS = ["done", "wrong usage", "bad input; the message names the file, the element, and its position",
          "not converged within the limits; the results are written", "a file cannot be read or written",
          "out of memory"]


def read_help(lines):
    """Usage, texts below their headings, and the footer. An entry is what it names, with an explanation."""
    usage, entries, footer, group = "", [], [], None
    for k, line in enumerate(lines):
        if line.startswith("Usage:"):
            usage = line
        elif re.match(r"\w.*:$", line) and not footer and lines[k + 1:k + 2] and lines[k + 1].startswith("  "):
            group = line[:-1]
        elif group and not footer and line.startswith(" " * COLUMN):
            entries[-1][2] += " " + line.strip()
        elif group and not footer and line.startswith("  "):
            is_short = len(line) < COLUMN or line[COLUMN - 1] == " "
            head, text = (line[:COLUMN], line[COLUMN:]) if is_short else (line, "")
            entries.append([group, head.strip(), text])
        elif group and (line or footer):
            footer.append(line)
    return usage, entries, "\n".join(footer).strip()


def read_entry(group, head, text, usage):
    first, _, rest = head.partition(" ")
    names = first.split(",") if first.startswith("-") else []
    value = rest.removesuffix("...").strip() if names else first
    optional, value = value.startswith("["), value.strip("[]")
    text = text.strip()
    required = text.endswith(" (required)") if names else f"[{value}" not in usage
    choices = value.split("|") if "|" in value else []
    return Entry(names, value, choices, optional, head.endswith("..."), required,
                 text.removesuffix(" (required)"), group)


def read_command(name, phrase, lines):
    usage, found, footer = read_help(lines)
    entries = [read_entry(*entry, usage) for entry in found]
    return Command(name, phrase, footer, [entry for entry in entries if not entry.names],
                   [entry for entry in entries if entry.names])


def split_examples(footer):
    """The footer before its examples, and the lines of these."""
    text, _, examples = footer.partition("\nExamples:\n")
    return text.strip(), [line.strip() for line in examples.splitlines()]


def sentence(phrase):
    return phrase[:1].upper() + phrase[1:].removesuffix(".") + "."


# ---- manual pages

def escaped(text):
    return re.sub(r"^(?=[.'])", r"\\&", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.MULTILINE)


def bold(text):
    return f"\\fB{escaped(text)}\\fR"


def italic(text):
    return f"\\fI{escaped(text)}\\fR"


def value_of(option):
    if not option.value:
        return ""
    text = bold(option.value).replace("|", "|\\:") if option.choices else italic(option.value)
    return f" [{text}]" if option.optional else f" {text}" + " ..." * option.repeated


def manual(name, version, help, synopsis, description, sections, see_also):
    lines = [f'.TH "{escaped(name.upper())}" 1 "" "{version}" "libflbc"', ".SH NAME",
             f"{escaped(name)} \\- {escaped(help[:1].lower() + help[1:].removesuffix('.'))}",
             ".SH SYNOPSIS", *synopsis, ".SH DESCRIPTION", *description]
    status = [(bold(str(number)), meaning) for number, meaning in enumerate(STATUS)]
    for title, tags in sections + [("EXIT STATUS", status)]:
        lines += [f".SH {title}"] * bool(tags)
        for tag, text in tags:
            lines += [".TP", tag, escaped(text)]
    return "\n".join(lines + [".SH SEE ALSO", see_also, ""])


def tags_of(options):
    return [(", ".join(map(bold, option.names)) + value_of(option),
             option.help + " (required)" * option.required) for option in options]


def optional(text, is_required):
    return text if is_required else f"[{text}]"


def manual_of_command(command, version):
    synopsis = [".nh", ".ad l", bold("flbc " + command.name)]
    synopsis += [optional(italic(argument.value) + " ..." * argument.repeated, argument.required)
                 for argument in command.arguments]
    synopsis += [optional(bold(option.names[-1]) + value_of(option), option.required)
                 for option in command.options]
    description = [escaped(sentence(command.help))]
    text, examples = split_examples(command.footer)
    if text:
        description += [".PP", escaped(text)]
    if examples:
        description += [".PP", ".nf", *map(escaped, examples), ".fi"]
    arguments = [(italic(argument.value), argument.help) for argument in command.arguments]
    return manual(f"flbc-{command.name}", version, command.help, synopsis + [".ad b", ".hy"], description,
                  [("ARGUMENTS", arguments), ("OPTIONS", tags_of(command.options))], bold("flbc") + "(1)")


def manual_of_program(program, commands, version):
    description = [escaped(program.help), "Each command has a page of its own,",
                   f"{bold('flbc-')}{italic('COMMAND')}(1), and", bold("--help") + "."]
    return manual("flbc", version, program.help, [f"{bold('flbc')} {italic('COMMAND')} ..."], description,
                  [("COMMANDS", [(bold(command.name), sentence(command.help)) for command in commands]),
                   ("OPTIONS", tags_of(program.options))],
                  ",\n".join(bold("flbc-" + command.name) + "(1)" for command in commands))


# ---- pages of the site

def in_cell(text):
    code = r"(^|[ (])(--?[a-z][a-z-]*|\.[a-z]{2,4}\b|[A-Za-z]*[_%][\w%.]*\w)"
    return re.sub(code, r"\1`\2`", text).replace("|", "\\|")


def with_value(option):
    value = "VALUE" if option.choices else option.value
    shown = f"[{value}]" if option.optional else value + " ..." * option.repeated
    return f"{option.names[-1]} {shown}" if value else option.names[-1]


def row(entry):
    names = entry.names[:-1] + [with_value(entry)] if entry.names else [entry.value]
    values = "; values: " + ", ".join(f"`{choice}`" for choice in entry.choices) if entry.choices else ""
    text = in_cell(entry.help) + values + " (required)" * bool(entry.names and entry.required)
    return f"| {', '.join(f'`{name}`' for name in names)} | {text} |"


def markdown_of_command(command):
    synopsis = ["flbc " + command.name]
    synopsis += [optional(argument.value + " ..." * argument.repeated, argument.required)
                 for argument in command.arguments]
    synopsis += [with_value(option) for option in command.options if option.required]
    lines = [f"# flbc {command.name}", "", sentence(command.help), "", "```",
             " ".join(synopsis + ["[OPTIONS]"]), "```", ""]
    text, examples = split_examples(command.footer)
    lines += [text, ""] * bool(text) + ["```sh", *examples, "```", ""] * bool(examples)
    entries = command.arguments + command.options
    for group in dict.fromkeys(entry.group for entry in entries):
        lines += [f"## {group}", "", "| Name | Meaning |", "|---|---|"]
        lines += [row(entry) for entry in entries if entry.group == group] + [""]
    return "\n".join(lines + ["See also: [exit status](../file_formats.md#exit-status), [all commands](index.md).", ""])


def markdown_of_program(commands):
    rows = "\n".join(f"| [`flbc {command.name}`]({command.name}.md) | {in_cell(command.help)} |"
                     for command in commands)
    return ("# Commands\n\nThe program `flbc` has these commands. `flbc COMMAND --help` prints the options of a "
            f"command.\n\n| Command | Purpose |\n|---|---|\n{rows}\n\n"
            "All commands use the same [exit status](../file_formats.md#exit-status).\n")


# ---- completion

BASH = """_flbc() {
  local current=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]}
  local values= options= previous=${COMP_WORDS[COMP_CWORD-1]}
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    COMPREPLY=($(compgen -W '@FIRST@' -- "$current"))
    return
  fi
  # An option that takes a value: nothing to offer but files if it is not one of a few.
  values=none
  case $command:$previous in
@VALUES@
  esac
  if [[ $values != none && $current != -* ]]; then
    [[ -z $values ]] || COMPREPLY=($(compgen -W "$values" -- "$current"))
    return
  fi
  [[ $current == -* ]] || return  # a file
  case $command in
@OPTIONS@
  esac
  COMPREPLY=($(compgen -W "$options" -- "$current"))
}
complete -o default -F _flbc flbc
"""

ZSH = """#compdef flbc
_flbc() {
  local curcontext=$curcontext state line
  typeset -A opt_args
  _arguments -C@FIRST@ \\
        '1:command:->command' '*::argument:->argument' && return
  case $state in
    command)
      local -a commands=(
@COMMANDS@
      )
      _describe -t commands command commands ;;
    argument)
      case $words[1] in
@OPTIONS@
      esac ;;
  esac
}
_flbc "$@"
"""


def filled(template, **parts):
    return re.sub("@([A-Z]+)@", lambda found: parts[found[1].lower()], template)


def names_of(options):
    return " ".join(name for option in options for name in option.names)


def bash(program, commands):
    values = [f"    {'|'.join(f'{command.name}:{name}' for name in option.names)}) "
              f'values="{" ".join(option.choices)}" ;;'
              for command in commands for option in command.options if option.value]
    options = [f"    {command.name}) options='{names_of(command.options)}' ;;" for command in commands]
    first = " ".join(command.name for command in commands) + " " + names_of(program.options)
    return filled(BASH, first=first, values="\n".join(values), options="\n".join(options))


def quoted(text):
    return re.sub(r"([\[\]:\\])", r"\\\1", text).replace("'", "'\\''")


def zsh_options(options):
    text = ""
    for option in options:
        values = f"({' '.join(option.choices)})" if option.choices else " " if option.value == "N" else "_files"
        value = f"{'::' if option.optional else ':'}{quoted(option.value)}:{values}" if option.value else ""
        for name in option.names:
            text += f" \\\n        '({' '.join(option.names)}){name}[{quoted(option.help)}]{value}'"
    return text


def zsh(program, commands):
    described = [f"        '{command.name}:{quoted(command.help)}'" for command in commands]
    options = [f"      {command.name})\n      _arguments -S{zsh_options(command.options)} \\\n"
               "        '*:file:_files' ;;" for command in commands]
    return filled(ZSH, first=zsh_options(program.options), commands="\n".join(described),
                  options="\n".join(options))


def main(folder, *program):
    def printed(*arguments):
        return subprocess.run([*program, *arguments], check=True, capture_output=True, text=True,
                              encoding="utf-8").stdout.splitlines()
    version, lines = printed("--version")[0], printed("--help")
    listed = [(head, text.strip()) for group, head, text in read_help(lines)[1] if group == "Commands"]
    whole = read_command("", lines[0], lines)
    commands = [read_command(name, text, printed(name, "--help-all")) for name, text in listed]
    files = {"flbc.1": manual_of_program(whole, commands, version), "index.md": markdown_of_program(commands),
             "flbc.bash": bash(whole, commands), "_flbc": zsh(whole, commands)}
    for command in commands:
        files[f"flbc-{command.name}.1"] = manual_of_command(command, version)
        files[f"{command.name}.md"] = markdown_of_command(command)
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    for old in [*folder.glob("flbc*"), *folder.glob("*.md")]:
        old.unlink()
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
