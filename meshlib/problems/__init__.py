"""Test functions, node sets and start meshes by name (sections 4.1 to 4.3).

All functions are in ``functions`` by name; those of the thesis are also available as
``SR1``, ``SR2``, ``SR3`` and ``DD1``.  Node sets and start meshes:

================  =====  ==========================================================
name              nodes  what it is
================  =====  ==========================================================
``"33"``             33  Appendix A: Franke's 33 nodes, rounded to one decimal
``"33-franke"``      33  Franke's 33 nodes as he published them
``"33-refined"``    121  the start mesh on ``"33"``, every element split in four
``"81"``             81  a 9 x 9 lattice, from four nodes by three refinements
================  =====  ==========================================================
"""

from .analytic_functions import TestFunction, functions
from .start_meshes import DD1, SR1, SR2, SR3, mesh, names, nodes, order

__all__ = ["DD1", "SR1", "SR2", "SR3", "TestFunction", "functions", "mesh", "names", "nodes", "order"]
