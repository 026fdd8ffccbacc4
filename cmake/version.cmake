# The definition of the version. The Blender add-on repeats it, and its test compares them.
set(FLBC_VERSION 0.1.0)
