"""Data-dependent triangulation: nodal values in, a better triangulation out."""

from importlib import import_module
from typing import TYPE_CHECKING

from . import criteria, curves, problems
from .approximation.approximate import Approximation, approximate
from .combination.combined import Combination, combined
from .errors import (
    DISTRIBUTION,
    CostError,
    Interrupted,
    InvalidInputError,
    InvalidMeshError,
    MeshError,
    NotReachedError,
    UnknownNameError,
)
from .interpolation.interpolant import Interpolant
from .interpolation.record import Record
from .mesh.delaunay import delaunay
from .mesh.mesh import Mesh
from .mesh.quality import Quality, quality, uniformity, valence
from .movement.smoothed import Smoothing, smoothed
from .movement.springs import DataSprings
from .optima.many_orders import LocalOptima, local_optima
from .optima.proved import Optimal, optimal
from .refinement.refined import Refinement, refined
from .swapping.annealing import Annealing, annealed
from .swapping.swapped import Swapping, swapped

if TYPE_CHECKING:
    from . import explorer, io, plotting

__version__ = "0.2.0"

__all__ = [
    "DISTRIBUTION",
    "Annealing",
    "Approximation",
    "Combination",
    "CostError",
    "DataSprings",
    "Interpolant",
    "Interrupted",
    "InvalidInputError",
    "InvalidMeshError",
    "LocalOptima",
    "Mesh",
    "MeshError",
    "NotReachedError",
    "Optimal",
    "Quality",
    "Record",
    "Refinement",
    "Smoothing",
    "Swapping",
    "UnknownNameError",
    "annealed",
    "approximate",
    "combined",
    "criteria",
    "curves",
    "delaunay",
    "explorer",
    "io",
    "local_optima",
    "optimal",
    "plotting",
    "problems",
    "quality",
    "refined",
    "smoothed",
    "swapped",
    "uniformity",
    "valence",
]


def __getattr__(name: str) -> object:
    """Load the modules for people, which need other packages, on first use."""
    if name in ("explorer", "io", "plotting"):
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
