"""Refinement: which elements are marked, and how they are split."""
