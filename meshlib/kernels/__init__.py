"""The hot loops: one source, compiled by numba where it is installed."""
