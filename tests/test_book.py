"""What the book adds to its pages: Python in the browser and the menu that leads to it."""
import subprocess
import sys
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).parents[1]
NOTEBOOK = "notebooks/03-methods.ipynb"


@pytest.fixture(autouse=True)
def extensions(monkeypatch):
    """The folder in which Sphinx finds the book's own extensions."""
    monkeypatch.syspath_prepend(ROOT / "book" / "_ext")


def test_no_service_without_an_address_of_the_repository():
    from launch import hosted
    assert list(hosted("", "main", NOTEBOOK)) == []


@pytest.mark.parametrize("repository, services", [
    ("https://github.com/owner/name", ["Binder", "Colab"]), ("https://codes.example/name", ["Binder"])])
def test_services_open_the_notebook_of_the_branch(repository, services):
    from launch import hosted
    entries = list(hosted(repository, "main", NOTEBOOK))
    assert [entry["text"] for entry in entries] == services
    assert all(entry["url"].endswith(NOTEBOOK) and "/main" in entry["url"] for entry in entries)


def test_a_compiled_package_is_packed_again_as_pure_python(tmp_path):
    """psygnal has compiled modules where this environment has a wheel for them."""
    pytest.importorskip("psygnal")
    from wheels import packed_again
    packed_again("psygnal", tmp_path)
    wheel, = tmp_path.iterdir()
    assert wheel.name.endswith("-py3-none-any.whl")
    assert not any(name.endswith((".so", ".pyd")) for name in ZipFile(wheel).namelist())
    subprocess.run([sys.executable, "-m", "wheel", "unpack", wheel, "--dest", tmp_path], check=True)
    there = "import psygnal; print(psygnal.__file__)"
    found = subprocess.run([sys.executable, "-c", there], cwd=next(tmp_path.glob("psygnal-*/")),
                           capture_output=True, text=True, check=True).stdout
    assert found.startswith(str(tmp_path))


def test_a_notebook_begins_with_the_installation_and_is_else_the_same():
    lite, nbformat = pytest.importorskip("lite", exc_type=ImportError), pytest.importorskip("nbformat")
    stored = nbformat.read(ROOT / NOTEBOOK, as_version=4)
    first, *rest = lite.installing(nbformat.read(ROOT / NOTEBOOK, as_version=4)).cells
    assert first.source.endswith("%pip install -q 'data-dependent-mesh[fem,plot,widgets]'")
    assert rest == stored.cells


def test_pyodide_is_the_release_whose_hashes_are_on_record_and_no_index_is_asked():
    lite = pytest.importorskip("lite", exc_type=ImportError)
    plugins = lite.settings(lite.PYODIDE_URL)["jupyter-config-data"]["litePluginSettings"]
    assert plugins[f"{lite.KERNEL}:kernel"] == {"pyodideUrl": lite.PYODIDE_URL, "disablePyPIFallback": True}
    assert (ROOT / "tests" / "browser" / f"pyodide-{lite.PYODIDE_VERSION}.sha256").exists()
