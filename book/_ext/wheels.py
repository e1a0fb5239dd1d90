"""Wheels for Python in the browser: the library and the packages that it needs there.

Pyodide has NumPy, SciPy and Matplotlib.  The pure Python packages beside them are
packed again from the environment that builds the book: nothing is downloaded, and
their versions are those of ``requirements.txt``.
"""

import subprocess
import sys
from importlib.metadata import distribution
from pathlib import Path
from shutil import copy2, copytree, ignore_patterns
from tempfile import TemporaryDirectory

REQUIREMENT = "data-dependent-mesh[fem,plot,widgets]"  # what a notebook installs
LIBRARY = ["meshlib", "pyproject.toml", "README.md", "LICENSE"]
CARRIED = [
    "anywidget",
    "comm",
    "ipywidgets",
    "jupyterlab-widgets",
    "psygnal",
    "scikit-fem",
    "typing-extensions",
]
PURE = "Wheel-Version: 1.0\nGenerator: meshlib\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
# Compiled twins of pure modules, and records of this installation.
LEFT_OUT = (".so", ".pyd", ".pyc", "INSTALLER", "REQUESTED", "RECORD", "direct_url.json")


def all_wheels(root, folder):
    """Write the wheels of the library in `root` and of the carried packages into `folder`."""
    library_wheel(root, folder)
    for name in CARRIED:
        packed_again(name, folder)


def library_wheel(root, folder):
    """Build the library from a clean copy, without modules left by an earlier build."""
    with TemporaryDirectory() as copy:
        for name in LIBRARY:
            _copied(Path(root, name), Path(copy, name))
        _python(
            "pip",
            "wheel",
            copy,
            "--no-deps",
            "--no-build-isolation",
            "--quiet",
            "--disable-pip-version-check",
            "--wheel-dir",
            folder,
        )


def packed_again(name, folder):
    """Write a pure Python wheel of an installed package."""
    with TemporaryDirectory() as contents:
        for file in filter(_travels, distribution(name).files):
            _copied(Path(file.locate()), Path(contents, file))
        next(Path(contents).glob("*.dist-info/WHEEL")).write_text(PURE)
        _python("wheel", "pack", contents, "--dest-dir", folder)


def _travels(file):
    """Whether a file goes into the wheel: scripts and data outside the package have ``..`` in their path."""
    return ".." not in file.parts and not file.name.endswith(LEFT_OUT)


def _copied(source, target):
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        copytree(source, target, ignore=ignore_patterns("__pycache__"))
    else:
        copy2(source, target)


def _python(*arguments):
    subprocess.run([sys.executable, "-m", *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)
