"""The combined strategy: on each patch the better of swapping and moving."""
