# Modules of the library. Each is an OBJECT library that finds only its own headers and those of its
# dependencies, so an include from a higher layer does not compile.
include_guard(DIRECTORY)
include(${CMAKE_CURRENT_LIST_DIR}/kernels.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/unity.cmake)

# flbc_add_module(NAME [HOT] [LIBRARY component] [DEPENDS module...] [HEADERS header...] [KERNELS kernel...]
#                 [LINKS library...] [DEFINES macro...] SOURCES file...)
# The sources of the current folder, which other files include as "NAME/header.h". NAME may be nested,
# such as solver/run.
# HOT      its loops outside of kernels take a measurable part of a solve, a deformation, or a run:
#          all optimizations
# LIBRARY  the optional component that contains the module, instead of the core
# HEADERS  public headers without a source of their name; those with one are found
# LINKS    other libraries that only this module uses
function(flbc_add_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg HOT LIBRARY "DEPENDS;HEADERS;KERNELS;LINKS;DEFINES;SOURCES")
  string(REPLACE / _ id ${name})
  list(TRANSFORM arg_DEPENDS REPLACE / _)
  list(TRANSFORM arg_DEPENDS PREPEND flbc_module_)
  set(target flbc_module_${id})
  add_library(${target} OBJECT ${arg_SOURCES})
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_compile_definitions(${target} PRIVATE ${arg_DEFINES})
  target_link_libraries(${target}
    PUBLIC Eigen3::Eigen ${arg_DEPENDS} PRIVATE OpenMP::OpenMP_CXX flbc_warnings ${arg_LINKS})
  flbc_position_independent(${target})

  # Other modules find the headers of this module in a directory of links.
  set(view ${flbc_MODULES}/${id})
  file(REMOVE_RECURSE ${view})
  cmake_path(GET name PARENT_PATH parent)
  file(MAKE_DIRECTORY ${view}/flbc ${view}/${parent})
  file(CREATE_LINK ${CMAKE_CURRENT_SOURCE_DIR} ${view}/${name} SYMBOLIC)
  foreach(source IN LISTS arg_SOURCES)
    cmake_path(GET source STEM header)
    if(EXISTS ${flbc_HEADERS}/flbc/${header}.h)
      list(APPEND arg_HEADERS ${header})
    endif()
  endforeach()
  foreach(header IN LISTS arg_HEADERS)
    file(CREATE_LINK ${flbc_HEADERS}/flbc/${header}.h ${view}/flbc/${header}.h SYMBOLIC)
  endforeach()
  set_property(GLOBAL APPEND PROPERTY flbc_headers_of_modules ${arg_HEADERS})
  target_include_directories(${target} PUBLIC ${view})

  set(library flbc)
  set(files_in_unit 12)
  if(NOT arg_HOT)
    flbc_optimise_lightly(${target})
  endif()
  if(arg_LIBRARY)
    set(library flbc_${arg_LIBRARY})
    set(files_in_unit 16)
  endif()
  if(name STREQUAL base)
    target_include_directories(${target} PUBLIC ${flbc_GENERATED_HEADERS})
  endif()
  # Compiling Eigen dominates build time. GCC compiles all that follows a precompiled header as it
  # compiled the header, so there are two: of the first hot module, and of the first other one.
  if(name STREQUAL base OR name STREQUAL mesh)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <functional> <map> <string> <vector>
      <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <Eigen/SparseCore>)
  elseif(arg_HOT)
    target_precompile_headers(${target} REUSE_FROM flbc_module_base)
  else()
    target_precompile_headers(${target} REUSE_FROM flbc_module_mesh)
  endif()
  flbc_compile_in_units(${target} ${files_in_unit})
  foreach(kernel IN LISTS arg_KERNELS)
    flbc_add_kernel(${target} ${name} ${kernel})
  endforeach()
  target_sources(${library} PRIVATE $<TARGET_OBJECTS:${target}>)
  target_link_libraries(${library} PRIVATE ${arg_LINKS})
endfunction()

# An optional library whose modules are added later. The license of the underlying library applies
# to the binary.
# \param ARGN  components that it depends on
function(flbc_add_component name)
  add_library(flbc_${name})
  add_library(flbc::${name} ALIAS flbc_${name})
  set_target_properties(flbc_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE CXX)
  target_link_libraries(flbc_${name} PUBLIC flbc::flbc ${ARGN})
  string(TOUPPER ${name} upper)
  target_compile_definitions(flbc_${name} INTERFACE FLBC_LINKS_${upper})  # make_domain.h
endfunction()

# Every public header except flbc.h belongs to exactly one module.
function(flbc_check_public_headers)
  get_property(owned GLOBAL PROPERTY flbc_headers_of_modules)
  file(GLOB headers RELATIVE ${flbc_HEADERS}/flbc CONFIGURE_DEPENDS ${flbc_HEADERS}/flbc/*.h)
  list(TRANSFORM headers REPLACE "\\.h$" "")
  foreach(header IN LISTS headers)
    set(owners ${owned})
    list(FILTER owners INCLUDE REGEX "^${header}$")
    list(LENGTH owners count)
    if(NOT header STREQUAL flbc AND NOT count EQUAL 1)
      message(FATAL_ERROR "flbc/${header}.h belongs to ${count} modules; name it in HEADERS of one, \
or give one a source of this name")
    endif()
  endforeach()
endfunction()
