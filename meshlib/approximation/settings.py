"""The numbers that steer `approximate`, in one object: the unit and the meaning of each.

`benchmarks/ablation.py` measures what each of them is worth.
"""

from dataclasses import dataclass


@dataclass(frozen=True)
class Start:
    """The first mesh on a rectangle: a lattice whose inner nodes are displaced at random."""

    cells: int = 3  # cells of the lattice along the shorter side
    jitter: float = 0.2  # largest displacement of a node in x and in y, in cells


@dataclass(frozen=True)
class Quadrature:
    """How the error is integrated, and which elements are too flat for that."""

    resolution: float = 40  # spacings of points, at most, along a square as large as the domain
    final_refinement: float = 4  # ratio of that spacing to the one that measures the final error
    most_quarterings: int = 6  # how often an element is divided into four, at most
    longest_part: float = 2.5  # longest side of a part of a divided element, in spacings
    most_halvings: int = 5  # how often the longest side of a part is halved, at most
    boundary_points: int = 4  # Gauss points along a boundary edge
    intervals: int = 8  # intervals along the sides of a part, between points that show the largest error
    flattest: float = 1e-5  # smallest area of an element, as a fraction of its longest side squared
    batch: int = 30_000  # points evaluated at once; with what is computed from them they fit into a cache


@dataclass(frozen=True)
class Objective:
    """What is lowered: the integral of a power of the error, with some weight on the boundary."""

    boundary_share: float = 0.1  # weight of the error along the boundary, in lengths of a typical element
    negligible: float = 1e-6  # error not worth a change, as a fraction of the mean error of an element
    squarings: int = 4  # how often the error is squared where the largest counts: its 16th power


@dataclass(frozen=True)
class Insertion:
    """New nodes in elements of large error."""

    growth: float = 0.25  # new nodes between two passes of swaps, at most, as a fraction of the nodes
    worst: float = 0.3  # smallest error of an element to be split, as a fraction of the largest
    candidates: float = 2  # elements examined for each new node
    widening: float = 10  # factor by which `worst` falls where none of these elements can be split
    widest: float = 1e-9  # value of `worst` at which the search for an element to be split ends


@dataclass(frozen=True)
class Division:
    """Coarser meshes, improved and then divided, and bisections where angles are limited."""

    fewest_nodes: int = 40  # nodes of the smallest mesh that is divided
    ratio: int = 4  # nodes of a mesh over those of the coarser mesh before it
    ratio_of_few: int = 2  # the same ratio, where the coarser mesh would be smaller than the smallest
    worthwhile: float = 0.1  # error of an element that is divided, as a fraction of the mean error
    tried_singly: int = 50  # elements bisected one by one where several at once break the limit


@dataclass(frozen=True)
class Removal:
    """Nodes merged into a neighbour, and nodes put on the boundary."""

    candidates: float = 3  # nodes examined for each one that is to be removed
    fewest_candidates: int = 40  # nodes examined at least
    neighbours: int = 3  # neighbours of a node into which its merging is tried
    near: float = 0.1  # height of a node that may be put on a boundary edge, as a fraction of its length
    from_ends: float = 0.05  # distance of such a node from the ends of the edge, as a fraction of its length


@dataclass(frozen=True)
class Moves:
    """Nodes moved by Newton's method."""

    probe: float = 0.08  # distance of points for differences of the function, in extents of the patch
    longest_step: float = 0.35  # longest move of a node at once, in extents of its patch
    step_shares: tuple[float, ...] = (1.6, 0.7)  # fractions of Newton's step that are tried in turn
    worthwhile: float = 1e-4  # smallest gain foreseen, as a fraction of the error of the patch
    smallest_gain: float = 1e-10  # smallest gain, as a fraction of the error of the patch; less is rounding
    grid: float = 2.0**-12  # spacing of the grid of steps, in extents of the patch
    least_curved: float = 1e-3  # smallest curvature of the model, as a fraction of its largest
    colouring: int = 2  # work of giving a node its colour, in steps of plain Python


@dataclass(frozen=True)
class Swaps:
    """Swaps of edges."""

    passes: int = 30  # passes over the edges, at most
    passes_between_insertions: int = 4  # passes over the edges between two insertions, at most
    smallest_gain: float = 1e-9  # smallest gain, as a fraction of the error of the two elements


@dataclass(frozen=True)
class Rounds:
    """How often a mesh is improved; more often if it has few nodes."""

    early: int = 3  # rounds of renewal on coarser meshes
    main: int = 8  # rounds of renewal on the final mesh, if it has a typical number of nodes
    levelling: int = 8  # rounds of renewal that lower the largest error
    typical_nodes: int = 1600  # nodes of a mesh with just the rounds named here
    fewest_times: float = 0.6  # smallest factor on the number of rounds, with many nodes
    most_times: float = 3  # largest factor on the number of rounds, with few nodes
    renewed: float = 0.3  # nodes removed and inserted again in the first round, as a fraction of all
    last_moves: int = 12  # moves of all nodes at the end, at most
    worthwhile: float = 1e-3  # gain of a move of all nodes that is worth another, as a fraction of the error


@dataclass(frozen=True)
class Lattice:
    """A regular mesh of a rectangle, which is tried as well."""

    promising: float = 1.5  # largest ratio of its objective to that of the mesh so far, if it is improved
    clearly_better: float = 0.9  # largest ratio at which it is taken, and no rounds of renewal are made


@dataclass(frozen=True)
class OneDirection:
    """Meshes for functions of one direction."""

    fewest_nodes: int = 12  # nodes of the smallest mesh of that kind
    difference: float = 1e-5  # distance for differences of the function, as a fraction of the shorter side
    points: int = 4000  # points at which it is checked that the function has one direction
    constant: float = 1e-6  # change along a line that counts as none, as a fraction of the range of values
    axis: float = 1e-7  # component of the unit direction that counts as none
    samples: int = 20_001  # points along the direction for its second derivative
    background: float = 1e-3  # density of nodes where the function is linear, as a fraction of the mean
    rounding: float = 1e-13  # second difference that counts as none, as a fraction of the largest value
    phases: int = 8  # places of the first node that are compared


@dataclass(frozen=True)
class NodeCount:
    """The search for the number of nodes that a tolerance needs."""

    fewest: int = 4  # nodes of the smallest mesh on a rectangle
    most: int = 200_000  # nodes of the largest mesh that is tried
    first: int = 30  # nodes of the mesh tried first
    close: float = 1.01  # ratio of a number that is enough to one that is not, at which the search ends
    slowest: float = 0.5  # smallest order of convergence that is believed
    fastest: float = 3.0  # largest order of convergence that is believed
    most_growth: float = 8.0  # factor by which the number grows at once, at most
    most_trials: int = 30  # meshes before the search ends
    largest_ratio: float = 1e9  # largest believable ratio of error and tolerance, either way
    fewer: tuple[float, ...] = (1.015, 1.03, 1.045, 1.06)  # divisors of the number found, tried at the end


@dataclass(frozen=True)
class Settings:
    """All settings, section by section."""

    start: Start = Start()
    quadrature: Quadrature = Quadrature()
    objective: Objective = Objective()
    insertion: Insertion = Insertion()
    division: Division = Division()
    removal: Removal = Removal()
    moves: Moves = Moves()
    swaps: Swaps = Swaps()
    rounds: Rounds = Rounds()
    lattice: Lattice = Lattice()
    one_direction: OneDirection = OneDirection()
    node_count: NodeCount = NodeCount()
