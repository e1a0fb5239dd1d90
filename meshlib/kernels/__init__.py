"""The hot loops: one source that runs as plain Python or compiled by numba, and the choice between both.

Loading numba takes some tenths of a second, in which plain Python finishes many small
jobs.  Whether loading is worth its time cannot be known before the last job.  The choice
therefore follows the *ski-rental rule*: rent (run plain Python) until the rents add up to
the price, then buy (load numba); whatever comes, that never costs more than twice what
was necessary.
"""

import os
from functools import cache
from math import inf

from ..checks import choice
from ..errors import missing_extra
from .backend import Compiled, Plain

BACKENDS = ("auto", "numba", "python")
PRICE = 300_000  # time to load numba, in steps of plain Python of about a microsecond
ANY = inf  # steps of a job that is worth loading numba in any case
_PLAIN = Plain()
_rent = 0.0  # steps that jobs of this process have asked for


def for_work(steps: float) -> Plain:
    """The kernels for a job: plain ones until it is worth loading numba, then compiled ones.

    This is the only place where that is decided.  The environment variable
    ``MESHLIB_BACKEND`` overrides the rule: ``python`` and ``numba`` stand for one of both,
    ``auto``, the default, for the rule, where numba is installed.

    The choice depends on what this process has done before; results do not depend on the
    choice.  Data in the form of one backend must be given to its own kernels.

    Parameters
    ----------
    steps : float
        Size of the job, in steps of plain Python of about a microsecond.

    Raises
    ------
    MeshError
        If ``MESHLIB_BACKEND`` is something else.
    ImportError
        If it is ``numba``, and numba is not installed.

    Examples
    --------
    >>> kernels = for_work(10)
    >>> kernels.lop.after(2)
    0
    """
    global _rent  # noqa: PLW0603 - the one state of a process that the rule needs
    wanted = choice(os.environ.get("MESHLIB_BACKEND", "auto"), BACKENDS, "MESHLIB_BACKEND")
    _rent += steps
    is_bought = _compiled.cache_info().currsize > 0
    if wanted == "python" or (wanted == "auto" and not is_bought and _rent <= PRICE):
        return _PLAIN
    found = _compiled()
    if found is None and wanted == "numba":
        raise missing_extra("numba", "fast")
    return found or _PLAIN


def compiled_for_work(steps: float) -> Plain | None:
    """The compiled kernels, if `for_work` chooses them: for jobs that array operations do as well."""
    found = for_work(steps)
    return found if found.is_compiled else None


@cache
def _compiled() -> Compiled | None:
    """The compiled kernels, if numba is installed."""
    try:
        import numba
    except ImportError:
        return None
    return Compiled(numba)
