"""Time and memory of calls, all in one process that does nothing else: ``python meter.py quality random 10000``."""
import gc
import json
import sys
import time
from pathlib import Path

from cases import Case
from measures import MEASURES

STATUS, RESET = Path("/proc/self/status"), Path("/proc/self/clear_refs")  # of Linux
SMALL = 400  # nodes of a case that loads and compiles everything first
MEGABYTE = 1 << 10  # in the kilobytes of the status


def resident(what):
    """Memory of this process in MB, ``"VmRSS"`` now or ``"VmHWM"`` at most; none if the system keeps silent."""
    if not STATUS.exists():
        return None
    line = next(line for line in STATUS.read_text().splitlines() if line.startswith(what))
    return int(line.split()[1]) / MEGABYTE


def memory(call):
    """How much memory a call adds at most, in MB."""
    gc.collect()
    before = resident("VmRSS")
    if before is None:
        call()
        return None
    RESET.write_text("5")  # forget the largest so far
    call()
    return resident("VmHWM") - before


def seconds(call):
    """Time that a call takes."""
    gc.collect()
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def measured(measure, kind, n, runs):
    """Memory of the first run of each call, then times of further runs, in turn."""
    for calls in MEASURES[measure](Case(kind, SMALL)):
        for call in calls.values():
            call()
    calls = [(who, name, call) for who, named in zip(("ours", "peer"), MEASURES[measure](Case(kind, n)), strict=True)
             for name, call in named.items()]
    added = [memory(call) for _, _, call in calls]
    times = [[seconds(call) for _, _, call in calls] for _ in range(runs)]
    return [{"measure": measure, "kind": kind, "nodes": n, "who": who, "name": name, "memory": mb, "times": list(row)}
            for (who, name, _), mb, row in zip(calls, added, zip(*times, strict=True), strict=True)]


if __name__ == "__main__":
    print(json.dumps(measured(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))))
