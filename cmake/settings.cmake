# Settings shared by the repository and by libflbc/ as a subdirectory of another project.
include_guard(DIRECTORY)
include(${CMAKE_CURRENT_LIST_DIR}/version.cmake)

option(FLBC_WITH_CGAL "2D meshing, self-intersection checks and automatic cages with CGAL (GPL-3)" ON)
option(FLBC_WITH_TETGEN "3D meshing with TetGen (AGPL-3)" ON)
option(FLBC_WITH_CHOLMOD "Factor with CHOLMOD (LGPL-2.1 / GPL-2) instead of Eigen" ON)

option(FLBC_WITH_OPENMP "Run loops in several threads; OFF for the web" ON)
if(FLBC_WITH_OPENMP)
  find_package(OpenMP REQUIRED COMPONENTS CXX)
elseif(NOT TARGET OpenMP::OpenMP_CXX)
  add_library(OpenMP::OpenMP_CXX INTERFACE IMPORTED)
  target_include_directories(OpenMP::OpenMP_CXX INTERFACE ${CMAKE_CURRENT_LIST_DIR}/without_openmp)
endif()

list(APPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
# On if its library is found.
find_package(Nglib QUIET)
option(FLBC_WITH_NETGEN "3D meshing with Netgen (LGPL-2.1) where TetGen fails" ${Nglib_FOUND})

# Of a program that links all components. Netgen is loaded at run time.
set(FLBC_LICENSE "BSD-3-Clause")
if(FLBC_WITH_CHOLMOD)
  set(FLBC_LICENSE "GPL-2.0-or-later, because of CHOLMOD (supernodal module)")
endif()
if(FLBC_WITH_CGAL)
  set(FLBC_LICENSE "GPL-3.0-or-later, because of CGAL")
endif()
if(FLBC_WITH_TETGEN)
  set(FLBC_LICENSE "AGPL-3.0-or-later, because of TetGen")
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
# Outside of kernels a * b + c is rounded twice, so that a formula gives the same result wherever it
# is inlined. Without -mfma, x86-64 knows nothing else.
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  add_compile_options(-ffp-contract=off)
endif()
include(${CMAKE_CURRENT_LIST_DIR}/warnings.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)

# For code that becomes part of a shared library, of the Python module, or of a plugin.
function(flbc_position_independent target)
  if(BUILD_SHARED_LIBS OR FLBC_BUILD_PYTHON OR FLBC_WITH_OPENFOAM)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  endif()
endfunction()

# Templates of Eigen fill memory that GCC frees often, although little of it can be freed. Freeing
# only above 1 GB saves a tenth of the compile time. Builds of other projects keep their memory.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND PROJECT_IS_TOP_LEVEL)
  add_compile_options(--param=ggc-min-heapsize=1000000)
endif()
