"""Node movement: the spring analogy and springs made from data."""
