# A room is compiled as one unit or a few: Eigen's templates are then instantiated once a room. Off,
# a change to one file compiles that file alone (-DFLBC_UNITY_BUILD=OFF, the preset `debug`).
include_guard(DIRECTORY)
option(FLBC_UNITY_BUILD "Compile the files of a room together" ON)

# Files that run once a command, not once an iteration: they take a third less to compile.
function(flbc_optimise_lightly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# \param most  files in one unit
function(flbc_compile_rooms_together target most)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    cmake_path(GET source PARENT_PATH room)
    cmake_path(GET room FILENAME room)  # what CGAL has to be compiled for is one unit: `cgal`
    string(MAKE_C_IDENTIFIER "${room}" room)
    if(NOT DEFINED files_in_${room})
      set(files_in_${room} 0)
    endif()
    math(EXPR unit "${files_in_${room}} / ${most}")
    math(EXPR files_in_${room} "${files_in_${room}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target}
      PROPERTIES UNITY_GROUP ${room}_${unit})
  endforeach()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${FLBC_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  # GCC takes files that a unit includes for headers, which had better have no anonymous namespaces.
  if(FLBC_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()
