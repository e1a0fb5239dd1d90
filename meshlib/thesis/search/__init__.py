"""The search for certificates: edge orders and perturbations that give the printed numbers."""
