"""Meshes made for a known function: nodes put where they lower the error most."""
from .approximate import Approximation, approximate

__all__ = ["Approximation", "approximate"]
