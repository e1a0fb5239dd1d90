"""Edge swapping: the local optimisation procedure, its schedules and simulated annealing."""
