r"""New nodes where the error is largest, each in the best of five places.

A new node p replaces one or two elements by the triangles from p to the edges around
them::

            c                 c                 c                  c
           / \               /|\               / \                /|\
          /   \             / | \             / | \              / | \
         a-----b   --->    a--p--b     or    a--p--b     or     a--p--b  (boundary)
          \   /             \ | /            (inside)
           \ /               \|/
            d                 d
"""

import numpy as np

from ..mesh.boundary_sides import INTERIOR
from ..mesh.topology import TAILS
from ..support.independent import coarse, independent


def inserted(draft, count, share=None):
    """The draft with up to ``count`` new nodes in elements of nearly the largest error.

    Where none of these can be split, elements of smaller errors are.
    """
    settings = draft.settings.insertion
    share = settings.worst if share is None else share
    worst = draft.worst(int(settings.candidates * count * settings.worst / share), share)
    stars = _Stars(draft, worst)
    gain = coarse(stars.gain(draft)).reshape(-1, len(worst))
    kind, column = gain.argmax(axis=0), np.arange(len(worst))
    best, gain = kind * len(worst) + column, gain[kind, column]
    possible = np.flatnonzero(np.isfinite(gain))
    touched = stars.touched[best[possible]]
    chosen = possible[
        independent(
            gain[possible], np.repeat(np.arange(len(possible)), 2), touched.ravel(), len(draft.elements)
        )[:count]
    ]
    if len(chosen):
        return stars.put_into(draft, best[chosen])
    return inserted(draft, count, share / settings.widening) if share > settings.widest else draft


class _Stars:
    """Places for a new node, five for each element: what each would replace, and by what.

    Attributes
    ----------
    points, values : (n, 2), (n,) ndarray of float
    touched : (n, 2) ndarray of int
        Elements that would go, the second -1 if there is only one.
    rim : (n, 4, 2) ndarray of int
        Ends of the edges around them, -1 where there are fewer than four.
    split : (n, 2) ndarray of int
        The ends of a boundary edge that would be split, or -1.
    """

    def __init__(self, draft, worst):
        kinds = [self._on_edge(draft, worst, k) for k in range(3)]
        kinds += [self._inside(draft, worst, points) for points in _inner_points(draft, worst)]
        self.points, self.touched, self.rim, self.split = (
            np.concatenate(part) for part in zip(*kinds, strict=True)
        )
        self.values = draft.misfit.values(*self.points.T.copy())

    @staticmethod
    def _on_edge(draft, worst, k):
        """The middle of the edge opposite node k."""
        mesh = draft.mesh
        apex, a, b = (mesh.elements[worst, (k + shift) % 3] for shift in range(3))
        beyond = mesh.neighbours[worst, k]
        far = np.where(beyond < 0, -1, mesh.elements[beyond].sum(axis=1) - a - b)
        outer = beyond < 0
        p, q = np.where(outer, -1, a), np.where(outer, -1, b)
        rim = np.stack([np.stack(pair, 1) for pair in ((apex, a), (b, apex), (far, q), (p, far))], 1)
        split = np.where(outer[:, None], np.stack([a, b], 1), -1)
        return (draft.nodes[a] + draft.nodes[b]) / 2, np.stack([worst, beyond], 1), rim, split

    @staticmethod
    def _inside(draft, worst, points):
        """A point inside."""
        nodes = draft.elements[worst]
        rim = np.full((len(worst), 4, 2), -1)
        rim[:, :3] = np.stack([nodes, nodes[:, TAILS]], axis=2)
        none = np.full(len(worst), -1)
        return points, np.stack([worst, none], 1), rim, np.stack([none, none], 1)

    def gain(self, draft):
        """By how much the error falls in each place; minus infinity where an element would be refused."""
        row, k = np.nonzero(self.rim[..., 0] >= 0)
        new = np.bincount(row, self._errors(draft, row, k), len(self.points))
        old = np.where(self.touched >= 0, draft.errors[self.touched], 0).sum(axis=1)
        boundary = np.flatnonzero(self.split[:, 0] >= 0)
        old[boundary] += draft.edge_error_of(self.split[boundary])
        for end in (0, 1):
            new[boundary] += self._edge_errors(draft, boundary, end)
        return old - new

    def _errors(self, draft, row, k):
        ends = self.rim[row, k]
        corners = np.concatenate([draft.nodes[ends], self.points[row][:, None]], axis=1)
        return draft.misfit.on_elements(corners, np.column_stack([draft.values[ends], self.values[row]]))

    def _edge_errors(self, draft, boundary, end):
        node = self.split[boundary, end]
        ends = np.stack([draft.nodes[node], self.points[boundary]], axis=1)
        values = np.stack([draft.values[node], self.values[boundary]], axis=1)
        return draft.weight * draft.misfit.on_edges(ends, values)

    def put_into(self, draft, chosen):
        """The draft with elements replaced by those around the new nodes."""
        row, k = np.nonzero(self.rim[chosen, :, 0] >= 0)
        new = np.column_stack([self.rim[chosen][row, k], draft.n_nodes + row]).astype(np.int32)
        kept = np.ones(len(draft.elements), dtype=bool)
        touched = self.touched[chosen]
        kept[touched[touched >= 0]] = False
        return draft.changed(
            np.concatenate([draft.nodes, self.points[chosen]]),
            np.concatenate([draft.elements[kept], new]),
            values=np.concatenate([draft.values, self.values[chosen]]),
            side=np.concatenate([draft.side, self._sides(draft, chosen)]),
            errors=np.concatenate([draft.errors[kept], np.full(len(new), np.nan)]),
            fresh=np.concatenate([draft.fresh[kept], np.ones(len(new), dtype=bool)]),
        )

    def _sides(self, draft, chosen):
        split, side = self.split[chosen], np.full(len(chosen), INTERIOR)
        boundary = np.flatnonzero(split[:, 0] >= 0)
        side[boundary] = draft.boundary.of_edges(split[boundary], draft.side)
        return side


def _inner_points(draft, worst):
    """Centroid, and the point of largest error among some."""
    corners, values = draft.nodes[draft.elements[worst]], draft.values[draft.elements[worst]]
    weights, miss = draft.misfit.misses(corners, values)
    weights = weights[coarse(np.abs(miss)).argmax(axis=1), :, None]
    return corners.mean(axis=1), (weights * corners).sum(axis=1)
