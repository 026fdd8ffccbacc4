# Shared libraries, with -DBUILD_SHARED_LIBS=ON. They carry their version, find each other after the
# tree has moved, and export only the names of public headers, by a list for the linker. Visibility
# attributes would be needed at every function, because the attribute of a namespace does not apply
# to templates that source files define.
if(NOT BUILD_SHARED_LIBS)
  return()
endif()
if(FLBC_BUILD_TESTS)
  message(FATAL_ERROR "The tests call what shared libraries do not export: \
-DFLBC_BUILD_TESTS=OFF, or build static libraries")
endif()
include(GNUInstallDirs)

set(shared_libraries flbc flbc_io flbc_cgal flbc_caging flbc_tetgen flbc_netgen flbc_openmesh)
# Internal headers of the core that the other libraries use.
set(shared_inside
  base/team_size cage/close_points cage/oriented_cage cage/point_in_cage coordinates/poisson_weights linear/dense
  mesh/cell_geometry problem/barycentric_constraints problem/laplacian solver/methods/method_run solver/plan/choices
  meshing/cgal/exact_predicates meshing/isolated_process
  meshing/meshing_common meshing/surface_subdivision meshing/vertex_count_search)
# Internal headers of the file formats that skins and programs use.
set(shared_inside_io
  model/bitmap model/following_normals model/gltf_document model/gltf_edit model/gltf_writer model/surface
  model/svg_document weights/npy_header weights/npz)

# What matches an expression in headers, as mangled names: length, word. Comments do not count.
function(flbc_names_in headers expression result)
  set(words)
  foreach(header IN LISTS headers)
    file(READ ${header} text)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
    string(REGEX REPLACE "//[^\n]*" "" text "${text}")
    string(REGEX MATCHALL "${expression}" found "${text}")
    list(TRANSFORM found REPLACE "\\(|(class|struct) " "")
    list(APPEND words ${found})
  endforeach()
  list(REMOVE_DUPLICATES words)
  # Namespaces would export all names in them.
  list(REMOVE_ITEM words flbc io openmesh distance gradient active_set splitting)
  set(mangled)
  foreach(word IN LISTS words)
    string(LENGTH ${word} length)
    list(APPEND mangled ${length}${word})
  endforeach()
  set(${result} ${mangled} PARENT_SCOPE)
endfunction()

# Functions, and what belongs to types: members, const members, type information. The linker matches
# every symbol with every pattern, so there are only those that may be needed.
function(flbc_list_exports namespace headers)
  set(name "[A-Za-z_][A-Za-z_0-9]*")
  flbc_names_in("${headers}" "${name}\\(" functions)
  flbc_names_in("${headers}" "(class|struct) ${name}" types)
  foreach(word IN LISTS functions types)
    string(APPEND exports "    _ZN${namespace}${word}*;\n")
  endforeach()
  foreach(kind NK TIN TSN TVN TTN)
    foreach(word IN LISTS types)
      string(APPEND exports "    _Z${kind}${namespace}${word}*;\n")
    endforeach()
  endforeach()
  string(APPEND exports "    _ZN${namespace}[a-z]*;\n")  # operators
  set(exports "${exports}" PARENT_SCOPE)
endfunction()

set(exports "    _ZN4flbc3abi*;\n")  # types.h
file(GLOB core libflbc/include/flbc/*.h libflbc/caging/include/flbc/*.h)
foreach(name IN LISTS shared_inside)
  list(APPEND core ${PROJECT_SOURCE_DIR}/libflbc/src/${name}.h)
endforeach()
file(GLOB io libflbc/io/include/flbc/io/*.h)
foreach(name IN LISTS shared_inside_io)
  list(APPEND io ${PROJECT_SOURCE_DIR}/libflbc/io/src/${name}.h)
endforeach()
file(GLOB openmesh openmesh_bindings/include/flbc/openmesh/*.h)
flbc_list_exports(4flbc "${core}")
flbc_list_exports(4flbc2io "${io}")
flbc_list_exports(4flbc4gltf "${io}")
flbc_list_exports(4flbc8openmesh "${openmesh}")
flbc_list_exports(4flbc8openmesh8internal "${openmesh}")  # what templates in headers call
file(CONFIGURE OUTPUT exports.map CONTENT "{\n  global:\n@exports@  local: *;\n};\n" @ONLY)

foreach(target IN LISTS shared_libraries)
  if(NOT TARGET ${target})
    continue()
  endif()
  # An interface may change with every minor version, as write_basic_package_version_file() says.
  set_target_properties(${target} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    INSTALL_RPATH "$ORIGIN")
  target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  # In UTF-8 locales, ld converts every symbol to wide characters for each pattern: 35 s, not 3 s.
  set_target_properties(${target} PROPERTIES
    CXX_LINKER_LAUNCHER "${CMAKE_COMMAND};-E;env;LC_ALL=C")
  target_link_options(${target} PRIVATE
    -Wl,--version-script=${CMAKE_CURRENT_BINARY_DIR}/exports.map)
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS
    ${CMAKE_CURRENT_BINARY_DIR}/exports.map)
endforeach()
if(TARGET flbc_app)
  file(RELATIVE_PATH to_libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  set_target_properties(flbc_app PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
endif()
