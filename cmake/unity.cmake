# Each source directory is compiled as one or a few units, so Eigen templates are instantiated once
# per directory. With -DFLBC_UNITY_BUILD=OFF (preset `debug`) a change to one file compiles only
# that file.
include_guard(DIRECTORY)
option(FLBC_UNITY_BUILD "Compile the files of a folder together" ON)

# For files that run once per command, not once per iteration: -O1 compiles a fifth faster.
function(flbc_optimise_lightly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# \param most  maximum number of files in one unit
# \param ARGN  ACROSS_FOLDERS: files of different folders share units
function(flbc_compile_in_units target most)
  get_target_property(sources ${target} SOURCES)
  get_target_property(folder ${target} SOURCE_DIR)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    cmake_path(GET source PARENT_PATH folder_of_source)
    cmake_path(GET folder_of_source FILENAME group)  # all files that include CGAL are in `cgal`
    string(MAKE_C_IDENTIFIER "${group}" group)
    if(ACROSS_FOLDERS IN_LIST ARGN)
      set(group files)
    endif()
    if(NOT DEFINED files_in_${group})
      set(files_in_${group} 0)
    endif()
    math(EXPR unit "${files_in_${group}} / ${most}")
    math(EXPR files_in_${group} "${files_in_${group}} + 1")
    set_source_files_properties(${source} TARGET_DIRECTORY ${target}
      PROPERTIES UNITY_GROUP ${group}_${unit})
  endforeach()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ${FLBC_UNITY_BUILD} UNITY_BUILD_MODE GROUP)
  # GCC treats the files of a unit as headers and warns about their anonymous namespaces.
  if(FLBC_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
endfunction()
