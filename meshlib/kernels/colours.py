"""Colours for nodes, so that joined ones differ."""

from .groups import Ints
from .marks import kernel

MOST = 62  # colours that fit into the bits of a number


@kernel
def first_free(starts: Ints, neighbours: Ints, colour: Ints) -> None:
    """Give each node in turn the first colour that no neighbour has; all are -1 before.

    Node n is joined to neighbours[starts[n]], ..., neighbours[starts[n + 1] - 1].
    """
    for n in range(len(colour)):
        taken = 0
        for i in range(starts[n], starts[n + 1]):
            c = colour[neighbours[i]]
            if 0 <= c < MOST:
                taken |= 1 << c
        c = 0
        while (taken >> c) & 1:
            c += 1
        colour[n] = c
