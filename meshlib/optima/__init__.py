"""The best of many meshes: local optima of many edge orders, the proved optimum, all meshes."""
