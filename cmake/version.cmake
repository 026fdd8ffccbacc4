# The one place that says it.
set(FLBC_VERSION 0.1.0)
