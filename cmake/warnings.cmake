# Warnings for files of this project; linked PRIVATE, so users do not inherit them.
add_library(flbc_warnings INTERFACE)
target_compile_options(flbc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
if(NOT FLBC_WITH_OPENMP)
  # Only pragmas use some parameters.
  target_compile_options(flbc_warnings INTERFACE -Wno-unknown-pragmas -Wno-unused-parameter)
endif()
# Calls of GoogleTest macros cause -Wpedantic warnings in clang.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(flbc_warnings INTERFACE -Wno-gnu-zero-variadic-macro-arguments)
endif()
