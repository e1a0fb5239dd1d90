"""Watching a long run: a bar that says how far it is, and an interrupt that keeps what is done."""

import signal
import threading
from collections.abc import Callable
from types import FrameType
from typing import Any

from ..errors import missing_extra


class Watch:
    """Watches a run that reports now and then; ``stopped`` is true after an interrupt (Ctrl-C).

    Parameters
    ----------
    progress : bool
        Whether to show a progress bar.
    total : int
        Count at which the bar ends.
    unit : str
        Name of what is counted.
    """

    part = 1 << 16  # number of edges inspected between two reports: some hundredths of a second, compiled

    def __init__(self, progress: bool, total: int, unit: str) -> None:
        self.stopped = False
        self._bar = bar(total=total, unit=unit) if progress else None
        self._handler: Callable[[int, FrameType | None], Any] | int | None = None

    def __enter__(self) -> "Watch":
        if threading.current_thread() is threading.main_thread():  # no other thread is interrupted
            self._handler = signal.getsignal(signal.SIGINT)
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._stop)
        return self

    def __exit__(self, *_: object) -> None:
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)
        if self._bar is not None:
            self._bar.close()

    def _stop(self, *_: object) -> None:
        self.stopped = True

    def report(self, done: int) -> None:
        """Move the bar to a count."""
        if self._bar is not None:
            self._bar.update(done - self._bar.n)


def bar(*arguments: Any, **options: Any) -> Any:
    """A progress bar of tqdm, in a notebook a widget."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise missing_extra("tqdm", "studies") from None
    return tqdm(*arguments, **options)
