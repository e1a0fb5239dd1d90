"""The piecewise linear interpolant on a mesh, and the search for the element of a point."""
