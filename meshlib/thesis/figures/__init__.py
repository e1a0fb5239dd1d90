"""The 41 figures of the thesis, each drawn by a function that returns it.

In a notebook assign it, ``fig = figures.figure_5_8()``; as the value of a cell it would be
shown twice.
"""

from . import chapter2, chapter3, chapter4, chapter5, chapter6
from .chapter2 import *  # noqa: F403
from .chapter3 import *  # noqa: F403
from .chapter4 import *  # noqa: F403
from .chapter5 import *  # noqa: F403
from .chapter6 import *  # noqa: F403

__all__ = chapter2.__all__ + chapter3.__all__ + chapter4.__all__ + chapter5.__all__ + chapter6.__all__
