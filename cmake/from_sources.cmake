# The libraries for systems other than this one: from Debian's headers that do not depend on the
# system, and from sources of its packages in /usr/src (scripts/install_dependencies.sh). For the
# web, and for the presets `windows` and `aarch64`, which include this file at project().
include_guard(GLOBAL)

# A folder of links: /usr/include itself has the headers of another C library. What find_package()
# finds is defined here.
set(headers ${CMAKE_CURRENT_BINARY_DIR}/headers)
set(modules ${CMAKE_CURRENT_BINARY_DIR}/modules)
file(MAKE_DIRECTORY ${headers} ${modules})
foreach(header boost CGAL CLI fast_float nlohmann)
  if(EXISTS /usr/include/${header})
    file(CREATE_LINK /usr/include/${header} ${headers}/${header} SYMBOLIC)
  endif()
endforeach()
list(PREPEND CMAKE_MODULE_PATH ${modules})
foreach(package CGAL CLI11 GTest PNG pugixml TetGen nlohmann_json ZLIB)
  file(WRITE ${modules}/Find${package}.cmake "set(${package}_FOUND TRUE)\n")
endforeach()
file(STRINGS /usr/include/CGAL/version.h version REGEX "^#define CGAL_VERSION [0-9]")
string(REGEX MATCH "[0-9.]+" version "${version}")
file(APPEND ${modules}/FindCGAL.cmake "set(CGAL_VERSION ${version})\n")
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "")
include_directories(SYSTEM ${headers})

foreach(library CGAL::CGAL CLI11::CLI11 nlohmann_json::nlohmann_json)
  add_library(${library} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${library} SYSTEM INTERFACE ${headers})
endforeach()
target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP=1 CGAL_NO_GMP=1 CGAL_NDEBUG)

# flbc_compile_library(NAME ALIAS INCLUDES SOURCES...)
function(flbc_compile_library name alias includes)
  add_library(${name} STATIC EXCLUDE_FROM_ALL ${ARGN})
  target_include_directories(${name} SYSTEM PUBLIC ${includes})
  target_compile_options(${name} PRIVATE -w -O2)
  target_compile_features(${name} PRIVATE cxx_std_17)
  add_library(${alias} ALIAS ${name})
endfunction()

set(from /usr/src)
flbc_compile_library(tet TetGen::TetGen ${from}/tetgen ${from}/tetgen/tetgen.cxx ${from}/tetgen/predicates.cxx)
target_compile_definitions(tet PUBLIC TETLIBRARY)

flbc_compile_library(pugixml pugixml::pugixml ${from}/pugixml/src ${from}/pugixml/src/pugixml.cpp)

if(EMSCRIPTEN)
  return()
endif()

# ---- for the program and the tests ---------------------------------------------------------------
enable_language(C)
file(GLOB sources ${from}/zlib/*.c)
flbc_compile_library(zlib ZLIB::ZLIB ${from}/zlib ${sources})

set(png ${CMAKE_CURRENT_BINARY_DIR}/libpng)
configure_file(${from}/libpng1.6/scripts/pnglibconf.h.prebuilt ${png}/pnglibconf.h COPYONLY)
file(GLOB sources ${from}/libpng1.6/png*.c)
list(FILTER sources EXCLUDE REGEX pngtest.c)
flbc_compile_library(png PNG::PNG "${from}/libpng1.6;${png}" ${sources})
target_link_libraries(png PUBLIC zlib)
target_compile_definitions(png PRIVATE PNG_ARM_NEON_OPT=0)

file(GLOB_RECURSE sources ${from}/openmesh/src/OpenMesh/Core/*.cc)
flbc_compile_library(OpenMeshCore OpenMesh::Core ${from}/openmesh/src ${sources})
target_compile_definitions(OpenMeshCore PUBLIC OM_STATIC_BUILD _USE_MATH_DEFINES PRIVATE NOMINMAX)
file(WRITE ${modules}/OpenMeshConfig.cmake "")
set(OpenMesh_DIR ${modules} CACHE PATH "")

set(from ${from}/googletest)
flbc_compile_library(gtest_main GTest::gtest_main
  "${from}/googletest/include;${from}/googlemock/include"
  ${from}/googletest/src/gtest-all.cc ${from}/googlemock/src/gmock-all.cc
  ${from}/googlemock/src/gmock_main.cc)
target_include_directories(gtest_main PRIVATE ${from}/googletest ${from}/googlemock)
add_library(GTest::gmock ALIAS gtest_main)
