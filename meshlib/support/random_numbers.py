"""Random numbers that are the same on every platform and with every version of NumPy."""

import numpy as np

SHIFT, UNIT = 11, 2.0**-53  # 64 random bits to the 53 of a float64 in [0, 1)


class Draws:
    """Numbers drawn one after the other from a seed.

    Parameters
    ----------
    seed : int or sequence of int
        At least 0.

    Notes
    -----
    NumPy promises the stream of bits of a bit generator for ever, but not what its
    `Generator` makes of them (NEP 19).  So the few distributions that are needed are made
    here; only `exponential` depends on the platform, in the last bit of its logarithm.

    Examples
    --------
    >>> draws = Draws(1)
    >>> draws.uniform(3).round(4).tolist(), draws.indices(6, 8).tolist()
    ([0.5118, 0.9505, 0.1442], [5, 1, 2, 4, 2, 3, 0, 4])
    """

    def __init__(self, seed):
        self._bits = np.random.PCG64(seed)

    def uniform(self, shape):
        """Float64 numbers of at least 0 and below 1, an array of this shape."""
        return (self._bits.random_raw(shape) >> np.uint64(SHIFT)) * UNIT

    def exponential(self, shape):
        """Float64 numbers above x with probability exp(-x), an array of this shape."""
        return -np.log1p(-self.uniform(shape))

    def indices(self, count, shape):
        """Int64 numbers from 0 to count - 1, all as likely, an array of this shape."""
        return (self.uniform(shape) * count).astype(np.int64)
