# Target `docs`: HTML documentation of the public interface, in docs/html of the build directory.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  configure_file(docs/Doxyfile.in docs/Doxyfile @ONLY)
  add_custom_target(docs
    COMMAND Doxygen::doxygen ${CMAKE_CURRENT_BINARY_DIR}/docs/Doxyfile
    COMMENT "Documentation of the public headers" VERBATIM)
endif()
