"""What several packages need: a progress bar, random numbers, sets of independent changes."""
