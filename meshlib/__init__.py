"""Data-dependent triangulation: nodal values in, a better triangulation out."""

from . import criteria, curves, problems
from .approximation.approximate import approximate
from .combination.combined import combined
from .errors import Interrupted, MeshError
from .interpolation.interpolant import Interpolant
from .mesh.delaunay import delaunay
from .mesh.mesh import Mesh
from .mesh.quality import quality, uniformity, valence
from .movement.smoothed import smoothed
from .movement.springs import DataSprings
from .optima.many_orders import local_optima
from .optima.proved import optimal
from .refinement.refined import refined
from .swapping.annealing import annealed
from .swapping.swapped import swapped

__version__ = "0.1.0"
DISTRIBUTION = "data-dependent-mesh"

__all__ = [
    "DataSprings",
    "Interpolant",
    "Interrupted",
    "Mesh",
    "MeshError",
    "annealed",
    "approximate",
    "combined",
    "criteria",
    "curves",
    "delaunay",
    "local_optima",
    "optimal",
    "problems",
    "quality",
    "refined",
    "smoothed",
    "swapped",
    "uniformity",
    "valence",
]
