"""Meshes made for a known function: nodes put where they lower the error most."""
