"""Times that only a new process shows: import, first use, and runs without a compiler."""

import subprocess
import sys

IMPORT = """
import time; start = time.perf_counter()
import meshlib
print(time.perf_counter() - start)
"""
FIRST = """
import time, meshlib
from meshlib import problems
mesh = problems.mesh("{mesh}")
start = time.perf_counter()
meshlib.swapped(mesh, problems.SR2)
print(time.perf_counter() - start)
"""
PLAIN = """
import os, time
os.environ["MESHLIB_BACKEND"] = "python"
import meshlib
from meshlib import problems
mesh, order = problems.mesh("{mesh}"), problems.order("{mesh}")
meshlib.swapped(mesh, problems.SR2, order=order)
start = time.perf_counter()
for _ in range(20):
    meshlib.swapped(mesh, problems.SR2, order=order)
print((time.perf_counter() - start) / 20)
"""
# Start of numba alone: a compiled function that does nothing, from the cache.
FLOOR = """
import time; start = time.perf_counter()
import numba
from meshlib.kernels import ANY, for_work
for_work(ANY).lop.after(1)
print(time.perf_counter() - start)
"""
SCRIPTS = {
    "import meshlib": IMPORT,
    "first swapping, 81 nodes": FIRST.format(mesh="81"),
    "numba alone": FLOOR,
    "without numba, 33 nodes": PLAIN.format(mesh="33"),
    "without numba, 81 nodes": PLAIN.format(mesh="81"),
}


def measured(runs):
    """Seconds of each script, in rounds; the first round fills the caches and does not count."""
    rounds = [[float(_output(script)) for script in SCRIPTS.values()] for _ in range(runs + 1)][1:]
    return [
        {
            "measure": "starting",
            "kind": "",
            "nodes": 0,
            "who": "ours",
            "name": name,
            "memory": None,
            "times": list(times),
        }
        for name, times in zip(SCRIPTS, zip(*rounds, strict=True), strict=True)
    ]


def _output(script):
    return subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True).stdout
