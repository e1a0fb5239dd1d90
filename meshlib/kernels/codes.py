"""Numbers by which kernels know criteria, norms and what happened to an edge; no compiler is needed."""

JND, ABN, DLP, DFP, USER_EDGE, SMALLEST_ANGLE, LARGEST_ANGLE, USER_ELEMENT = range(8)
SUM, SQUARES, MAXIMUM = 1, 2, 0  # norms: L1, L2, largest
UNKNOWN, REFUSED, TRIED, SWAPPED, INVALID = -1, 0, 1, 2, 3  # INVALID: a user-defined cost is not a cost
PLACE, WAITING, SWAPS, SWEEPS, TRIES, BEFORE, FAULT = range(7)  # places in a tally, see `schedules`
