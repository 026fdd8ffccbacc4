# The Netgen library, which Debian installs in nonstandard directories.
find_path(Nglib_INCLUDE_DIR nglib.h PATH_SUFFIXES netgen)
find_library(Nglib_LIBRARY NAMES nglib PATH_SUFFIXES netgen)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Nglib REQUIRED_VARS Nglib_LIBRARY Nglib_INCLUDE_DIR)
mark_as_advanced(Nglib_INCLUDE_DIR Nglib_LIBRARY)
