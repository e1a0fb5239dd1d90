"""Long runs: a bar on request, and an interrupt that leaves a valid mesh."""

import signal
import threading

import numpy as np
import pytest

import meshlib.support.progress
from meshlib import Interrupted, delaunay, problems, swapped
from meshlib.support.progress import Watch


@pytest.fixture
def start():
    return delaunay(np.random.default_rng(5).random((300, 2)))


@pytest.fixture
def interrupted(monkeypatch):
    """Ctrl-C at the second report, with reports after every hundred edges."""
    reports = []

    def report(watch, done):
        reports.append(done)
        if len(reports) == 2:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(Watch, "part", 100)
    monkeypatch.setattr(Watch, "report", report)
    return reports


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
@pytest.mark.parametrize("order", [None, "given"])
def test_an_interrupt_keeps_what_is_done(start, interrupted, schedule, order):
    u = problems.functions["franke"]
    order = None if order is None else np.arange(start.n_edges)[::-1]
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt) as stop:
        swapped(start, u, "abn", norm=1, order=order, schedule=schedule)
    found = stop.value.result
    assert isinstance(stop.value, Interrupted) and len(interrupted) == 2
    assert found.mesh.validate().counts == start.counts
    assert 0 < found.swaps <= found.tried <= 200 and found.cost_after < found.cost_before
    assert found.history["accepted"].sum() == found.swaps and len(found.history) == found.tried
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
def test_a_run_in_parts_is_the_run_in_one(start, schedule, monkeypatch):
    u = problems.functions["franke"]
    whole = swapped(start, u, "abn", norm=1, schedule=schedule)
    for part in (1, 7, 1000):
        monkeypatch.setattr(Watch, "part", part)
        found = swapped(start, u, "abn", norm=1, schedule=schedule)
        assert found.mesh.equals(whole.mesh)
        assert (found.swaps, found.sweeps, found.tried) == (whole.swaps, whole.sweeps, whole.tried)


@pytest.mark.parametrize("schedule", ["sweep", "queue"])
def test_the_bar_ends_at_the_number_of_edges_or_before(start, schedule, monkeypatch):
    class Bar:
        n, made = 0, []

        def __init__(self, total, unit):
            self.total, self.seen, self.closed = total, [], False
            self.made.append(self)

        def update(self, step):
            self.n += step
            self.seen.append(self.n)

        def close(self):
            self.closed = True

    monkeypatch.setattr(meshlib.support.progress, "bar", Bar)
    monkeypatch.setattr(Watch, "part", 100)
    swapped(start, problems.functions["franke"], schedule=schedule, progress=True)
    (bar,) = Bar.made
    assert bar.total == start.n_edges and bar.closed and len(bar.seen) > 5
    assert all(0 <= n <= bar.total for n in bar.seen)


def test_a_bar_is_shown(start, capsys, monkeypatch):
    pytest.importorskip("tqdm")
    monkeypatch.setattr(Watch, "part", 100)
    swapped(start, problems.functions["franke"], progress=True)
    assert "edge" in capsys.readouterr().err


def test_other_threads_run_too(start):
    found = []
    thread = threading.Thread(target=lambda: found.append(swapped(start, problems.functions["franke"])))
    thread.start()
    thread.join()
    assert found[0].swaps > 0
