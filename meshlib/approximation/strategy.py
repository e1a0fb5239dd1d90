"""The strategy: grow a mesh, then take nodes out, put them in again and move them, in rounds."""
from .collapse import collapse, settle_on_boundary
from .insertion import insert
from .moves import move
from .swaps import swap

GROWTH = 0.25  # of the nodes, inserted at once at most
FEW_PASSES = 4  # of swaps between two insertions
DOUBLINGS = 20
SMALLEST = 40  # nodes at which the mesh is improved first
EARLY_ROUNDS, ROUNDS, LAST_MOVES = 3, 6, 6
TAKEN_OUT = 0.3  # of the nodes in the first round, less in each further one


def steps(draft, n_nodes):
    """How many steps there will be."""
    return sum(2 * rounds + 2 for _, rounds in _sizes(draft, n_nodes)) + LAST_MOVES


def strategy(draft, n_nodes, note):
    """Adapt a draft with so many nodes; ``note`` is told after each step what it was."""
    for size, rounds in _sizes(draft, n_nodes):
        grown(draft, size)
        note("grown")
        for k in range(rounds):
            improved(draft)
            note("moved")
            renewed(draft, size, TAKEN_OUT * (1 - k / ROUNDS))
            note("renewed")
        improved(draft)
        note("moved")
    for _ in range(LAST_MOVES):
        improved(draft)
        note("moved")


def _sizes(draft, n_nodes):
    """Numbers of nodes at which the mesh is improved, each twice the one before, and the rounds at each."""
    halves = [round(n_nodes / 2 ** k) for k in range(DOUBLINGS, 0, -1)]
    early = [(size, EARLY_ROUNDS) for size in halves if size > max(draft.n_nodes, SMALLEST)]
    return [*early, (n_nodes, ROUNDS)]


def grown(draft, n_nodes):
    """Insert nodes until there are so many."""
    inserted = True
    while inserted and draft.n_nodes < n_nodes:
        inserted = insert(draft, min(n_nodes - draft.n_nodes, max(1, int(GROWTH * draft.n_nodes))))
        swap(draft, FEW_PASSES)
        settle_on_boundary(draft)
    swap(draft)


def improved(draft):
    """Move all nodes once, and swap."""
    move(draft)
    settle_on_boundary(draft)
    swap(draft)


def renewed(draft, n_nodes, share):
    """Take out a share of the nodes, and put as many in again elsewhere."""
    collapse(draft, share)
    swap(draft)
    grown(draft, n_nodes)
