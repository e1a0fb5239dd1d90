"""Watching a long run: a bar that says how far it is, and an interrupt that keeps what is done."""

import signal
import threading

from ..errors import missing_extra

PART = 1 << 16  # edges inspected between two looks; a few hundredths of a second, compiled


class Watch:
    """Looks after a run that reports now and then; ``stopped`` after an interrupt (Ctrl-C).

    Parameters
    ----------
    progress : bool
        Whether to show a progress bar.
    total : int
        Where the bar ends.
    unit : str
        What it counts.
    """

    part = PART

    def __init__(self, progress, total, unit):
        self.stopped = False
        self._bar = bar(total=total, unit=unit) if progress else None
        self._handler = None

    def __enter__(self):
        if threading.current_thread() is threading.main_thread():  # no other thread is interrupted
            self._handler = signal.getsignal(signal.SIGINT)
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._stop)
        return self

    def __exit__(self, *_):
        if self._handler is not None:
            signal.signal(signal.SIGINT, self._handler)
        if self._bar is not None:
            self._bar.close()

    def _stop(self, *_):
        self.stopped = True

    def report(self, done):
        """Move the bar."""
        if self._bar is not None:
            self._bar.update(done - self._bar.n)


def bar(*arguments, **options):
    """A progress bar, in a notebook a widget."""
    try:
        from tqdm.auto import tqdm
    except ImportError:
        raise missing_extra("tqdm", "studies") from None
    return tqdm(*arguments, **options)
