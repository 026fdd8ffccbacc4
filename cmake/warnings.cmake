# Warnings for the project's own files: linked PRIVATE, so that no user inherits them.
add_library(flbc_warnings INTERFACE)
target_compile_options(flbc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# GoogleTest's macros are called with fewer arguments than clang's -Wpedantic likes.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  target_compile_options(flbc_warnings INTERFACE -Wno-gnu-zero-variadic-macro-arguments)
endif()
