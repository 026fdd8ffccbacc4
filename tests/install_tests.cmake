# Whether strangers can use what is built: the package in a prefix that was moved, with CMake and
# with pkg-config, and the sources as a sub-directory. Nothing is compiled that need not be.
set(consumer ${CMAKE_CURRENT_SOURCE_DIR}/install_consumer)
set(work ${CMAKE_CURRENT_BINARY_DIR}/install)
set(prefix ${work}/moved)

# The consumer is built as this build is: sanitizers have to be linked, for example. A few jobs at a
# time, because other tests run beside it.
set(build_as_here
  --build-generator ${CMAKE_GENERATOR} --build-makeprogram ${CMAKE_MAKE_PROGRAM} --build-options
  -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_JOB_POOLS=two=2 -DCMAKE_JOB_POOL_COMPILE=two)
set(with_these_flags -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE} -DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS})
set(run_its_tests --test-command ${CMAKE_CTEST_COMMAND} --output-on-failure)

set(components)
foreach(component cgal tetgen openmesh)
  if(TARGET flbc::${component})
    list(APPEND components ${component})
  endif()
endforeach()
string(REPLACE ";" " " component_list "${components}")

function(flbc_add_install_test name)
  add_test(NAME ${name} ${ARGN})
  set_tests_properties(${name} PROPERTIES
    LABELS install TIMEOUT 900 ENVIRONMENT OMP_WAIT_POLICY=passive)
endfunction()

# ---- the package ---------------------------------------------------------------------------------
flbc_add_install_test(install_prefix
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DCONFIG=$<CONFIG> -DWORK=${work}
    -P ${CMAKE_CURRENT_SOURCE_DIR}/install_prefix.cmake)
set_tests_properties(install_prefix PROPERTIES FIXTURES_SETUP flbc_prefix)

flbc_add_install_test(install_consumer
  COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${consumer} ${work}/consumer ${build_as_here}
    ${with_these_flags} -Dflbc_ROOT=${prefix} "-DCOMPONENTS=${component_list}" ${run_its_tests})
flbc_add_install_test(install_no_such_component
  COMMAND ${CMAKE_COMMAND} -S ${consumer} -B ${work}/no_such_component
    -Dflbc_ROOT=${prefix} -DCOMPONENTS=magic)
set_tests_properties(install_no_such_component PROPERTIES
  PASS_REGULAR_EXPRESSION "flbc has no[ \n]+component[ \n]+'magic'")
flbc_add_install_test(install_component_not_built
  COMMAND ${CMAKE_COMMAND} -S ${consumer} -B ${work}/component_not_built
    -Dflbc_ROOT=${work}/core_only -DCOMPONENTS=tetgen)
set_tests_properties(install_component_not_built PROPERTIES
  PASS_REGULAR_EXPRESSION "built[ \n]+without[ \n]+its[ \n]+component[ \n]+'tetgen'")
set(tests install_consumer install_no_such_component install_component_not_built)

find_program(FLBC_PKG_CONFIG NAMES pkg-config pkgconf)
if(FLBC_PKG_CONFIG)
  flbc_add_install_test(install_pkg_config
    COMMAND ${CMAKE_COMMAND} -DPKG_CONFIG=${FLBC_PKG_CONFIG} -DCOMPILER=${CMAKE_CXX_COMPILER}
      -DFLAGS=${CMAKE_CXX_FLAGS} -DPREFIX=${prefix} -DSOURCE=${consumer}/use_core.cpp
      -P ${CMAKE_CURRENT_SOURCE_DIR}/install_pkg_config.cmake)
  list(APPEND tests install_pkg_config)
endif()
if(TARGET flbc_app)
  include(GNUInstallDirs)
  flbc_add_install_test(install_program
    COMMAND ${CMAKE_COMMAND} -E env ${prefix}/${CMAKE_INSTALL_BINDIR}/flbc --version)
  list(APPEND tests install_program)
endif()
set_tests_properties(${tests} PROPERTIES FIXTURES_REQUIRED flbc_prefix)

# ---- the sources as a sub-directory --------------------------------------------------------------
# What may go wrong there is configuring, finding headers and linking. So the core alone is compiled
# once, not optimised; with the whole repository, only what stands in the stranger's own project.
flbc_add_install_test(subdirectory_libflbc
  COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${consumer} ${work}/subdirectory_libflbc
    --build-noclean ${build_as_here} -DCMAKE_BUILD_TYPE= -DCMAKE_CXX_FLAGS=-O0 -DCOMPONENTS=
    -DFLBC_SUBDIRECTORY=${PROJECT_SOURCE_DIR}/libflbc -DFLBC_WITH_CGAL=OFF -DFLBC_WITH_TETGEN=OFF
    ${run_its_tests})
set_tests_properties(subdirectory_libflbc PROPERTIES PROCESSORS 2)

set(with_components)
foreach(component cgal tetgen openmesh)
  string(TOUPPER ${component} upper)
  list(APPEND with_components -DFLBC_WITH_${upper}=$<BOOL:$<TARGET_EXISTS:flbc::${component}>>)
endforeach()
flbc_add_install_test(subdirectory_repository
  COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${consumer} ${work}/subdirectory_repository
    --build-noclean --build-target consumer_objects ${build_as_here} ${with_these_flags}
    "-DCOMPONENTS=${component_list}" -DFLBC_SUBDIRECTORY=${PROJECT_SOURCE_DIR} ${with_components})
