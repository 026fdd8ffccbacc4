# Install rules; included after all targets are defined. Installed files do not contain the prefix,
# so the tree can be moved. What was not built is left out. Install components are the packages
# (package.cmake): core, meshers, and openmesh have runtime files; core_dev, meshers_dev, and
# openmesh_dev have files for compiling and linking; program has the program, and python the Python
# module (python/CMakeLists.txt).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/flbc)

# One export per component. flbcConfig.cmake offers components whose file is in its directory, so
# components with copyleft licenses can be in separate packages.
function(flbc_install_component component package)
  foreach(target IN LISTS ARGN)
    if(NOT TARGET ${target})
      return()
    endif()
    install(TARGETS ${target} EXPORT flbc_${component} OPTIONAL
      LIBRARY COMPONENT ${package} NAMELINK_COMPONENT ${package}_dev
      ARCHIVE COMPONENT ${package}_dev
      INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  endforeach()
  install(EXPORT flbc_${component} NAMESPACE flbc:: FILE flbc-${component}.cmake
    DESTINATION ${package_dir} COMPONENT ${package}_dev)
  list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
  install(CODE "
    foreach(file ${files})
      file(GLOB exports
        \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${package_dir}/flbc-${component}*.cmake)
      if(exports AND NOT EXISTS \${file})
        file(REMOVE \${exports})
      endif()
    endforeach()" COMPONENT ${package}_dev)
endfunction()
flbc_install_component(core core flbc flbc_io)
flbc_install_component(cgal meshers flbc_cgal)
flbc_install_component(caging meshers flbc_caging)
flbc_install_component(tetgen meshers flbc_tetgen)
flbc_install_component(netgen meshers flbc_netgen)
flbc_install_component(openmesh openmesh flbc_openmesh flbc_gltf)
if(TARGET flbc_app)
  install(TARGETS flbc_app OPTIONAL COMPONENT program)
  find_program(FLBC_HELP2MAN help2man)
  if(FLBC_HELP2MAN AND NOT CMAKE_CROSSCOMPILING)
    set(manual ${CMAKE_CURRENT_BINARY_DIR}/flbc.1)
    install(CODE "
      if(EXISTS $<TARGET_FILE:flbc_app>)
        execute_process(
          COMMAND ${FLBC_HELP2MAN} --no-info \"--name=${PROJECT_DESCRIPTION}\" --output=${manual}
            $<TARGET_FILE:flbc_app>
          COMMAND_ERROR_IS_FATAL ANY)
      endif()" COMPONENT program)
    install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL COMPONENT program)
  endif()
  install(FILES engines/deform.glsl engines/deform.wgsl engines/webgl.html
    DESTINATION ${CMAKE_INSTALL_DATADIR}/flbc/engines COMPONENT program)
endif()

# ---- headers -------------------------------------------------------------------------------------
install(DIRECTORY libflbc/include/flbc libflbc/io/include/flbc libflbc/caging/include/flbc
  $<TARGET_PROPERTY:flbc,BINARY_DIR>/include/flbc
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT core_dev FILES_MATCHING PATTERN "*.h")
if(TARGET flbc_openmesh)
  install(DIRECTORY openmesh_bindings/include/flbc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    COMPONENT openmesh_dev FILES_MATCHING PATTERN "*.h")
  install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
    COMPONENT openmesh_dev FILES_MATCHING PATTERN "*.cpp" PATTERN "*.py" PATTERN CMakeLists.txt)
endif()

# ---- the CMake package ---------------------------------------------------------------------------
configure_package_config_file(cmake/flbcConfig.cmake.in flbcConfig.cmake
  INSTALL_DESTINATION ${package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(flbcConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/flbcConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/flbcConfigVersion.cmake
  DESTINATION ${package_dir} COMPONENT core_dev)
install(FILES cmake/FindCHOLMOD.cmake cmake/FindTetGen.cmake DESTINATION ${package_dir}/modules
  COMPONENT core_dev)

# ---- pkg-config ----------------------------------------------------------------------------------
file(RELATIVE_PATH FLBC_PC_PREFIX
  ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" FLBC_PC_PREFIX ${FLBC_PC_PREFIX})
file(RELATIVE_PATH FLBC_PC_LIBDIR ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_LIBDIR})
file(RELATIVE_PATH FLBC_PC_INCLUDEDIR ${CMAKE_INSTALL_PREFIX} ${CMAKE_INSTALL_FULL_INCLUDEDIR})
set(FLBC_PC_LIBS_PRIVATE ${OpenMP_CXX_FLAGS})
if(FLBC_WITH_CHOLMOD)
  find_package(CHOLMOD REQUIRED)
  cmake_path(GET CHOLMOD_LIBRARY PARENT_PATH cholmod_dir)
  if(NOT cholmod_dir IN_LIST CMAKE_CXX_IMPLICIT_LINK_DIRECTORIES)
    string(APPEND FLBC_PC_LIBS_PRIVATE " -L${cholmod_dir}")
  endif()
  string(APPEND FLBC_PC_LIBS_PRIVATE " -lcholmod")
endif()
configure_file(cmake/flbc.pc.in flbc.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/flbc.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT core_dev)

# A component's own libraries, in the order of static linking, and other packages of flbc that it
# needs. Which meshers a program links decides FLBC_LINKS_... in make_domain.h.
function(flbc_install_pc component package libraries)
  if(NOT TARGET flbc_${component})
    return()
  endif()
  string(TOUPPER ${component} upper)
  list(JOIN ARGN " " required)
  configure_file(cmake/flbc-component.pc.in flbc-${component}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/flbc-${component}.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${package}_dev)
endfunction()
flbc_install_pc(cgal meshers "-lflbc_cgal -lmpfr -lgmp")
flbc_install_pc(caging meshers "-lflbc_caging" flbc-cgal)
flbc_install_pc(tetgen meshers "-lflbc_tetgen -ltet")
flbc_install_pc(netgen meshers "-lflbc_netgen")
flbc_install_pc(openmesh openmesh "-lflbc_openmesh -lflbc_gltf -lOpenMeshCore")

install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT core_dev)
