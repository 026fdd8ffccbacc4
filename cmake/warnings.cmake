# Warnings for the project's own files: linked PRIVATE, so that no user inherits them.
add_library(flbc_warnings INTERFACE)
target_compile_options(flbc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
