"""Data-dependent triangulation: nodal values in, a better triangulation out."""
from . import criteria, curves, problems
from .annealing import annealed
from .approximation import approximate
from .combined import combined
from .delaunay import delaunay
from .errors import Interrupted, MeshError
from .interpolant import Interpolant
from .mesh import Mesh
from .movement import smoothed
from .optima import local_optima
from .optimal import optimal
from .quality import quality, uniformity, valence
from .refinement import refined
from .springs import DataSprings
from .swapping import swapped

__version__ = "0.1.0"
DISTRIBUTION = "data-dependent-mesh"

__all__ = ["DataSprings", "Interpolant", "Interrupted", "Mesh", "MeshError", "annealed", "approximate",
           "combined", "criteria", "curves", "delaunay", "local_optima", "optimal", "problems", "quality",
           "refined", "smoothed", "swapped", "uniformity", "valence"]
