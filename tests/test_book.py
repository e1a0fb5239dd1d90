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
    """The folder in which Sphinx finds the extensions of the book."""
    monkeypatch.syspath_prepend(ROOT / "book" / "_ext")


def test_no_service_without_an_address_of_the_repository():
    from launch import hosted

    assert list(hosted("", "main", NOTEBOOK)) == []


@pytest.mark.parametrize(
    "repository, services",
    [("https://github.com/owner/name", ["Binder", "Colab"]), ("https://codes.example/name", ["Binder"])],
)
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
    (wheel,) = tmp_path.iterdir()
    assert wheel.name.endswith("-py3-none-any.whl")
    assert not any(name.endswith((".so", ".pyd")) for name in ZipFile(wheel).namelist())
    subprocess.run([sys.executable, "-m", "wheel", "unpack", wheel, "--dest", tmp_path], check=True)
    there = "import psygnal; print(psygnal.__file__)"
    found = subprocess.run(
        [sys.executable, "-c", there],
        cwd=next(tmp_path.glob("psygnal-*/")),
        capture_output=True,
        text=True,
        check=True,
    ).stdout
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


@pytest.mark.parametrize(
    "source, plain",
    [
        ("(sec-1)=\n## Title\n\nSee {numref}`x`.", "## Title\n\nSee Words 1."),
        ("In {doc}`x`, {eq}`elsewhere`.", "In Words 1, [Words 1](04-other.ipynb)."),
        ("$$\na = b\n$$ (eq-1)", "$$\na = b\n\\tag{Words 1} $$"),
        ("Term\n: What it means.", "**Term.** What it means."),
        (
            "```{prf:theorem} Name\n:label: x\n\nBy {ref}`x`.\n```",
            "---\n\n**Words 1 (Name).**\n\nBy Words 1.\n\n---",
        ),
        ("```{prf:proof}\nClear.\n```", "---\n\n**Proof.**\n\nClear.\n\n---"),
        (
            "```{admonition} Two\n:class: note\n\nText.\n```\n\n```{rubric} Next\n```",
            "---\n\n**Two.**\n\nText.\n\n---\n\n**Next**",
        ),
    ],
)
def test_myst_becomes_plain_markdown(source, plain):
    references = pytest.importorskip("references", exc_type=ImportError)

    class Known(references.Plain):
        def _resolved(self, role, target):
            return "Words 1", "04-other.html" if target == "elsewhere" else ""

    assert Known(None, "notebooks/03-this").text(source) == plain


def test_a_caption_stands_below_its_figure():
    references = pytest.importorskip("references", exc_type=ImportError)
    nbformat = pytest.importorskip("nbformat")

    class Known(references.Plain):
        def _resolved(self, role, target):
            return f"{role} {target}", ""

    figure = {"mystnb": {"figure": {"name": "fig-1", "caption": "What is seen."}}}
    cells = [nbformat.v4.new_code_cell("draw()", metadata=figure), nbformat.v4.new_markdown_cell("Then.")]
    found = Known(None, "x").notebook(nbformat.v4.new_notebook(cells=cells)).cells
    assert [cell.source for cell in found] == ["draw()", "*numref fig-1.* What is seen.", "Then."]
