# The only definition of the version.
set(FLBC_VERSION 0.1.0)
