"""The mesh, its derived arrays and invariants, Delaunay meshes and measures of quality."""
