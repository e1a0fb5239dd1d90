"""Geometry without a mesh: exact predicates, quadrature, polygons and a space-filling curve."""
