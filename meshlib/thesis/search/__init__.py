"""The search for certificates: an edge order and a perturbation that give printed numbers."""
