"""Nodes to measure on: random, in clusters, and on a lattice full of ties."""

import numpy as np

import meshlib as ml
from meshlib import problems

CLUSTERS, WIDEST, DENSEST = 40, 0.1, 0.001  # number of clusters; largest and smallest standard deviation


def random(n, rng):
    """Uniform in the unit square."""
    return rng.random((n, 2))


def clustered(n, rng):
    """Normal clouds of very different density; what falls outside is folded back into the square."""
    centre, width = rng.random((CLUSTERS, 2)), np.geomspace(DENSEST, WIDEST, CLUSTERS)
    cloud = rng.integers(CLUSTERS, size=n)
    away = np.abs(centre[cloud] + width[cloud, None] * rng.normal(size=(n, 2))) % 2
    return np.minimum(away, 2 - away)


def gridded(n, rng):
    """A square lattice of about n nodes: the four nodes of each cell lie on a circle."""
    side = np.linspace(0, 1, round(n**0.5))
    return np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)


KINDS = {"random": random, "clustered": clustered, "gridded": gridded}


class Case:
    """Nodes of one kind, their Delaunay mesh, values of Franke's function, and as many random points."""

    def __init__(self, kind, n, seed=0):
        rng, self.kind = np.random.default_rng(seed), kind
        self.nodes = KINDS[kind](n, rng)
        self.points = rng.random((2, len(self.nodes)))
        self.mesh = ml.delaunay(self.nodes)
        self.u = problems.functions["franke"]
        self.values = self.u(*self.nodes.T)

    def fresh(self):
        """The mesh with nothing derived from it yet."""
        return ml.Mesh._trusted(self.mesh.nodes, self.mesh.elements)
