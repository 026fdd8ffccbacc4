# Headers and libraries of OpenFOAM (openfoam.com), from its environment (FOAM_SRC, FOAM_LIBBIN) or
# from /usr. Debian's package has no headers; scripts/install_dependencies.sh openfoam brings them.
# Defines OpenFOAM::OpenFOAM.
set(openfoam_parts OpenFOAM meshTools finiteVolume dynamicMesh fileFormats surfMesh)
find_path(OpenFOAM_SOURCE_DIR dynamicMesh/lnInclude/points0MotionSolver.H
  HINTS $ENV{FOAM_SRC} /usr/src/openfoam/src)
set(openfoam_required OpenFOAM_SOURCE_DIR)
foreach(part IN LISTS openfoam_parts)
  find_library(OpenFOAM_${part}_LIBRARY NAMES ${part} HINTS $ENV{FOAM_LIBBIN})
  list(APPEND openfoam_required OpenFOAM_${part}_LIBRARY)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenFOAM REQUIRED_VARS ${openfoam_required})
if(OpenFOAM_FOUND AND NOT TARGET OpenFOAM::OpenFOAM)
  add_library(OpenFOAM::OpenFOAM INTERFACE IMPORTED)
  set(label_size 32)
  if(DEFINED ENV{WM_LABEL_SIZE})
    set(label_size $ENV{WM_LABEL_SIZE})
  endif()
  target_compile_definitions(OpenFOAM::OpenFOAM INTERFACE
    OPENFOAM WM_DP WM_LABEL_SIZE=${label_size} NoRepository)
  foreach(part IN LISTS openfoam_parts)
    target_include_directories(OpenFOAM::OpenFOAM SYSTEM INTERFACE
      ${OpenFOAM_SOURCE_DIR}/${part}/lnInclude)
    target_link_libraries(OpenFOAM::OpenFOAM INTERFACE ${OpenFOAM_${part}_LIBRARY})
  endforeach()
  target_include_directories(OpenFOAM::OpenFOAM SYSTEM INTERFACE
    ${OpenFOAM_SOURCE_DIR}/OSspecific/POSIX/lnInclude)
endif()
