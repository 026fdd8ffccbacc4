# FLBC_BUILD_PYTHON: on at top level where Python's headers, NumPy, and pybind11 are found. Known
# before the libraries, because the module needs them position-independent.
include_guard(DIRECTORY)
if(NOT PROJECT_IS_TOP_LEVEL AND NOT FLBC_BUILD_PYTHON)
  return()
endif()
# Debian's own Python has Debian's packages, whichever Python comes first in PATH.
if(NOT Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
# Only its headers: its own search for Python does not take the interpreter found above.
set(PYBIND11_NOPYTHON ON)
find_package(pybind11 2.10 QUIET CONFIG)
set(found OFF)
if(Python3_Development.Module_FOUND AND Python3_NumPy_FOUND AND pybind11_FOUND)
  set(found ON)
endif()
option(FLBC_BUILD_PYTHON "Build the Python module flbc" ${found})
if(FLBC_BUILD_PYTHON)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter Development.Module NumPy)
  find_package(pybind11 2.10 REQUIRED CONFIG)
endif()
