"""Put JupyterLite beside the pages: the notebooks as real Python in the browser.

The folder ``lite`` of the site holds JupyterLite, the notebooks, and wheels of the
library and of what Pyodide lacks.  Pyodide itself comes from its content delivery
network when a reader starts a kernel, or from the site if the environment variable
``MESHLIB_PYODIDE`` names a folder with the files of that release.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from shutil import copytree, rmtree
from tempfile import TemporaryDirectory

import nbformat
from references import Plain
from wheels import REQUIREMENT, all_wheels

PYODIDE_VERSION = "0.27.7"
PYODIDE_URL = f"https://cdn.jsdelivr.net/pyodide/v{PYODIDE_VERSION}/full/pyodide.js"
OWN_PYODIDE = "./static/pyodide/pyodide.js"
KERNEL = "@jupyterlite/pyodide-kernel-extension"
EXTENSIONS = [KERNEL, "@jupyter-widgets/jupyterlab-manager", "anywidget"]
KERNELSPEC = {"name": "python", "display_name": "Python (Pyodide)", "language": "python"}
APPS = ["notebooks", "tree", "lab", "edit"]
INSTALL = f"%pip install -q '{REQUIREMENT}'"
NOTE = "JupyterLite: the library and what it needs, once in each session."
CONTENTS = "files"
NOTEBOOKS = re.compile("notebooks/")
# Files that the page on performance reads.
DATA = ["benchmarks/*.py", "benchmarks/*.json"]


def build_lite(app, exception):
    """Build the folder ``lite`` of a finished HTML site."""
    if exception or app.builder.format != "html":
        return
    target = Path(app.outdir, "lite")
    rmtree(target, ignore_errors=True)
    with TemporaryDirectory() as folder:
        _write_contents(app, Path(folder, CONTENTS))
        _write_rest(app.srcdir, Path(folder))
        _run_jupyterlite(folder, target)


def _write_contents(app, folder):
    """The notebooks of the pages, and the files that one of them reads."""
    for page in filter(NOTEBOOKS.match, sorted(app.env.found_docs)):
        notebook = nbformat.read(app.srcdir / f"{page}.ipynb", as_version=4)
        # Not by nbformat, which writes text as lists of lines: JupyterLite shows no output of lists.
        _write(folder / f"{page}.ipynb", json.dumps(installing(Plain(app, page).notebook(notebook))))
    for path in (path for pattern in DATA for path in app.srcdir.glob(pattern)):
        _write(folder / path.relative_to(app.srcdir), path.read_text())


def _write_rest(root, folder):
    """Wheels, settings, and Pyodide if the site is to carry it."""
    wheels = folder / "pypi"
    wheels.mkdir()
    all_wheels(root, wheels)
    if own := os.environ.get("MESHLIB_PYODIDE"):
        copytree(own, folder / "static/pyodide")
    _write(folder / "jupyter-lite.json", json.dumps(settings(OWN_PYODIDE if own else PYODIDE_URL)))
    _write(folder / "jupyter_lite_config.json", json.dumps(build_options()))


def installing(notebook):
    """The notebook with a first cell that installs the library."""
    cell = nbformat.v4.new_code_cell(f"# {NOTE}\n{INSTALL}", id="install")
    notebook.cells.insert(0, cell)
    notebook.metadata.kernelspec = nbformat.from_dict(KERNELSPEC)
    return notebook


def settings(pyodide_url):
    """Settings of JupyterLite: the address of Pyodide, and no look-up in a package index."""
    kernel = {"pyodideUrl": pyodide_url, "disablePyPIFallback": True}
    return {
        "jupyter-lite-schema-version": 0,
        "jupyter-config-data": {
            "appName": "Data dependent meshes",
            "exposeAppInBrowser": True,
            "litePluginSettings": {f"{KERNEL}:kernel": kernel},
        },
    }


def _write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def build_options():
    """Options of the build: only the named extensions, whatever else the environment has."""
    installed = Path(sys.prefix, "share/jupyter/labextensions")
    return {
        "LiteBuildConfig": {
            "apps": APPS,
            "contents": [CONTENTS],
            "no_libarchive": True,
            "no_sourcemaps": True,
            "no_unused_shared_packages": True,
            "ignore_sys_prefix": ["federated_extensions"],
            "federated_extensions": [str(installed / name) for name in EXTENSIONS],
        }
    }


def _run_jupyterlite(folder, target):
    done = subprocess.run(
        [sys.executable, "-m", "jupyterlite_core", "build", "--output-dir", str(target)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"JupyterLite was not built:\n{done.stdout}\n{done.stderr}")


def setup(app):
    """Register the building step with Sphinx."""
    app.connect("build-finished", build_lite)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
