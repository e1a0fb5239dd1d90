"""Times, memory and errors against peers, in one run on the same data.

    python benchmarks/run.py --nodes 10000 100000 1000000 --sizes 100 400 --json benchmarks/results.json

Each measure, and each function that is approximated, has a separate process, in which
ours and the peers take turns.  Results are printed and, with ``--json``, written to a file
together with the machine and the versions; the page "Performance" of the report shows that
file.  Without ``--nodes`` or without ``--sizes`` the file keeps what it has of that part.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
from datetime import date
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from approximation import FUNCTIONS, bounds
from cases import KINDS
from measures import MEASURES
from starting import measured as started

HERE = Path(__file__).parent
PACKAGES = ("numpy", "scipy", "numba", "matplotlib", "scikit-fem", "pyvista", "vtk", "mmgpy", "pydelatin")


def about():
    """The machine and the versions."""
    return {
        "date": str(date.today()),
        "machine": platform.machine(),
        "processor": _processor(),
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "versions": {name: found for name in PACKAGES if (found := _version(name))},
    }


def _processor():
    info = Path("/proc/cpuinfo")
    names = (
        [
            line.split(":")[1].strip()
            for line in info.read_text().splitlines()
            if line.startswith("model name")
        ]
        if info.exists()
        else []
    )
    return names[0] if names else platform.processor()


def _version(name):
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def lines(measure, kind, n, runs):
    """Results of one measure on one case, from a separate process."""
    command = [sys.executable, HERE / "meter.py", measure, kind, str(n), str(runs)]
    return json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)


def show(line):
    """Print one result."""
    memory = "" if line["memory"] is None else f"{line['memory']:9.0f} MB"
    print(
        f"{line['measure']:<11} {line['kind']:<10} {line['nodes']:>8} {line['who']:<5} {line['name']:<25} "
        f"{statistics.median(line['times']):10.4f} s {memory}",
        flush=True,
    )


def timed(chosen):
    """The part with times and memory: machine, versions, and a result for each call."""
    results = started(chosen.runs)
    for line in results:
        show(line)
    for n in chosen.nodes:
        for kind in chosen.kinds:
            for measure in chosen.measures:
                found = lines(measure, kind, n, chosen.runs)
                results += found
                for line in found:
                    show(line)
    return about() | {"results": results}


def approximated(chosen):
    """The part with meshes made for functions, a line for each mesh."""
    found = []
    for name in chosen.functions:
        command = [sys.executable, HERE / "approximation.py", name, *map(str, chosen.sizes)]
        new = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)
        for line in new:
            print(
                f"{name:<9} {line['who']:<10} {line['nodes']:>6} {line['found']:>6} nodes  "
                f"error {line['error']:.4e} {line['seconds']:9.2f} s",
                flush=True,
            )
        found += new
    return {"approximate": about() | bounds() | {"lines": found}}


def text(parts):
    """The results as JSON, a line for each entry of a list."""

    def value(found):
        if not isinstance(found, list):
            return json.dumps(found, ensure_ascii=False)
        return "[\n  " + ",\n  ".join(value(row) for row in found) + "\n ]"

    def entries(found, indent):
        rows = (
            f'{indent}"{key}": ' + (entries(one, indent + " ") if key == "approximate" else value(one))
            for key, one in found.items()
        )
        return "{\n" + ",\n".join(rows) + f"\n{indent[1:]}}}"

    return entries(parts, " ") + "\n"


def main(arguments=None):
    """Measure, print and write."""
    as_it_is = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=as_it_is)
    parser.add_argument("--nodes", type=int, nargs="*", default=[], help="of meshes for times and memory")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS))
    parser.add_argument("--measures", nargs="+", choices=MEASURES, default=list(MEASURES))
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--sizes", type=int, nargs="*", default=[], help="nodes of meshes made for functions")
    parser.add_argument("--functions", nargs="+", choices=FUNCTIONS, default=list(FUNCTIONS))
    parser.add_argument("--json", type=Path, help="write the results to this file")
    chosen = parser.parse_args(arguments)
    parts = json.loads(chosen.json.read_text()) if chosen.json and chosen.json.exists() else {}
    for wanted, measure in ((chosen.nodes, timed), (chosen.sizes, approximated)):
        if wanted:
            parts |= measure(chosen)
    if chosen.json:
        chosen.json.write_text(text(parts))


if __name__ == "__main__":
    main()
