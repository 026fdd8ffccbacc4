# The definition of the version; between releases that of the next one, with -dev. The Blender add-on
# repeats it, and its test compares them.
set(FLBC_VERSION 0.3.1-dev)
string(REGEX REPLACE "-.*" "" FLBC_VERSION_NUMBER ${FLBC_VERSION})
