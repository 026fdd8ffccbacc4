#!/bin/sh
# Runs the examples of the command pages, docs/reference/cli/COMMAND.sh, in the order of flbc --help,
# in a folder laid out as the repository. They write below out/ only.
# cli_examples_test.sh FLBC REPOSITORY WORK
set -eu
flbc=$1 repository=$2 work=$3
examples=$repository/docs/reference/cli
fail() {
  echo "$1" >&2
  exit 1
}
rm -rf "$work"
mkdir -p "$work/bin"
ln -s "$flbc" "$work/bin/flbc"
ln -s "$repository/meshes" "$work/meshes"
PATH=$work/bin:$PATH
cd "$work"
commands=$(flbc --help | sed -n '/^Commands:/,$s/^  \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | sort)" = "$(basename -s .sh "$examples"/*.sh | sort)" ] ||
  fail "not one example for each command: $commands"
for command in $commands; do
  grep -q "^flbc $command " "$examples/$command.sh" || fail "$command.sh: another command"
  printed=$(sh -eu "$examples/$command.sh" 2>&1) || fail "$command.sh: $printed"
  [ "$(ls -A | xargs)" = "bin meshes out" ] || fail "$command.sh: wrote outside out/"
done

# The examples of --help, in a folder with the files that they name.
mkdir "$work/help"
cd "$work/help"
for name in cage model; do cp "$repository/meshes/3d/limb_$name.obj" "$name.obj"; done
cp "$repository/meshes/3d/limb_cage_pose.obj" pose.obj
for command in solve sparsify deform export cage run; do
  flbc $command --help | sed -n '/^Examples:$/,$s/^  flbc /flbc /p' >examples.sh
  [ "$(wc -l <examples.sh)" = 2 ] || fail "flbc $command --help: not two examples"
  printed=$(sh -eu examples.sh 2>&1) || fail "flbc $command --help: $printed"
done
