"""Time and memory of calls, in a separate process: ``python meter.py quality random 10000 5``."""

import gc
import json
import sys
import time
from pathlib import Path

from cases import Case
from measures import MEASURES

STATUS, RESET = Path("/proc/self/status"), Path("/proc/self/clear_refs")  # exist on Linux
SMALL = 400  # nodes of the first case, which loads and compiles everything
MEGABYTE = 1 << 10  # kilobytes, the unit of the status


def resident(what):
    """Memory of this process in MB, ``"VmRSS"`` now or ``"VmHWM"`` at its peak; None where unknown."""
    if not STATUS.exists():
        return None
    line = next(line for line in STATUS.read_text().splitlines() if line.startswith(what))
    return int(line.split()[1]) / MEGABYTE


def memory(call):
    """Peak memory that a call adds, in MB."""
    gc.collect()
    before = resident("VmRSS")
    if before is None:
        call()
        return None
    RESET.write_text("5")  # reset the peak
    call()
    return resident("VmHWM") - before


def seconds(call):
    """Time of a call in seconds."""
    gc.collect()
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def measured(measure, kind, n, runs):
    """Memory of the first run of each call, then times of further runs, in turn."""
    for calls in MEASURES[measure](Case(kind, SMALL)):
        for call in calls.values():
            call()
    both = zip(("ours", "peer"), MEASURES[measure](Case(kind, n)), strict=True)
    calls = [(who, name, call) for who, named in both for name, call in named.items()]
    added = [memory(call) for _, _, call in calls]
    times = [[seconds(call) for _, _, call in calls] for _ in range(runs)]
    case = {"measure": measure, "kind": kind, "nodes": n}
    return [
        case | {"who": who, "name": name, "memory": most, "times": list(row)}
        for (who, name, _), most, row in zip(calls, added, zip(*times, strict=True), strict=True)
    ]


if __name__ == "__main__":
    print(json.dumps(measured(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))))
