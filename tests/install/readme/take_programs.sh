#!/bin/sh
# Usage: take_programs.sh README FOLDER
# Makes a project FOLDER/programN of each C++ block of a README with its CMake block.
set -eu
rm -rf "$2"
count=$(grep -c '^```cpp$' "$1")
for n in $(seq "$count"); do
  folder=$2/program$n
  mkdir -p "$folder"
  block=$(awk -v n="$n" '/^```cpp$/ { at++; next } /^```$/ { if (at == n) exit } at == n' "$1")
  {
    printf '%s\n' "$block" | grep '^#'
    echo 'int main() {'
    printf '%s\n' "$block" | grep -v '^#'
    echo '}'
  } > "$folder/program.cpp"
  {
    echo 'cmake_minimum_required(VERSION 3.25)'
    echo 'project(readme_program LANGUAGES CXX)'
    echo 'add_executable(your_program program.cpp)'
    awk '/^```cmake$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$1"
  } > "$folder/CMakeLists.txt"
done
