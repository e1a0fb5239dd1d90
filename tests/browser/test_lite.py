"""The chapters as real Python in the browser: Pyodide says what the notebooks store.

Two chapters by default, all of them with MESHLIB_LITE=all, which takes more than an hour.
"""

import os
import re
from pathlib import Path

import nbformat
import pytest
from pyodide_files import RELEASE, UnavailableError, folder
from visiting import served

NOTEBOOKS = Path(__file__).parents[2] / "notebooks"
EVERY = sorted(path.stem for path in NOTEBOOKS.glob("*.ipynb"))
CHAPTERS = EVERY if os.environ.get("MESHLIB_LITE") == "all" else ["03-methods", "08-conclusions"]
NETWORK = f"https://cdn.jsdelivr.net/pyodide/v{RELEASE}/full/"
SECONDS = 5400
# The current notebook, once its kernel runs; its cells as JSON after running them all.
READY = "() => window.jupyterapp?.shell.currentWidget?.context?.isReady"
RUN = """async seconds => {
    const { commands, shell } = window.jupyterapp, notebook = shell.currentWidget;
    await notebook.sessionContext.ready;
    const late = new Promise((_, fail) => setTimeout(() => fail(new Error('too slow')), 1000 * seconds));
    await Promise.race([commands.execute('notebook:run-all-cells'), late]);
    return JSON.stringify(notebook.content.model.toJSON()); }"""
# To the first explorer: JupyterLab hides cells that are far from those to be seen.
SCROLL = """() => {
    const { content } = window.jupyterapp.shell.currentWidget;
    const drawn = cell => cell.node.querySelector('.mesh-explorer');
    return content.scrollToItem(content.widgets.findIndex(drawn)); }"""
OTHER_TEXT = "([element, text]) => element.textContent !== text"
MYST = re.compile(r"\{[a-z:]+\}`|`{3}\{|^\([\w-]+\)=", re.MULTILINE)
ONCE_ON_STDERR = "Matplotlib is building the font cache"


@pytest.fixture(scope="module")
def address(site):
    """Where the built site is served on this machine."""
    with served(site) as found:
        yield found


@pytest.fixture(scope="module")
def pyodide():
    """The folder that stands for the content delivery network."""
    try:
        return folder()
    except UnavailableError as reason:
        pytest.skip(f"without Pyodide {RELEASE} no chapter ran in the browser: {reason}")


@pytest.fixture
def lite(chromium, address, pyodide):
    """A page, and a list to which a request to a third host is added."""
    context, elsewhere = chromium.new_context(), []

    def answer(route):
        file = pyodide / route.request.url.removeprefix(NETWORK)
        if file.is_file():
            route.fulfill(path=file, headers={"Access-Control-Allow-Origin": "*"})
        else:
            elsewhere.append(route.request.url)
            route.abort()

    context.route(lambda url: not url.startswith((address, "data:", "blob:")), answer)
    yield context.new_page(), elsewhere
    context.close()


def said(cell):
    """What a code cell printed, returned or failed with, without pictures and controls."""
    found = []
    for output in cell.outputs:
        if output.output_type == "stream":
            found.append((output.name, output.text))
        elif output.output_type == "error":
            found.append((output.ename, output.evalue))
        else:
            found += sorted(
                (kind, text)
                for kind, text in output.data.items()
                if not kind.startswith(("image/", "application/"))
            )
    return [(kind, text) for kind, text in found if not text.startswith(ONCE_ON_STDERR)]


def code_cells(notebook):
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


@pytest.mark.parametrize("chapter", CHAPTERS)
def test_a_chapter_says_in_the_browser_what_its_notebook_stores(lite, address, chapter):
    page, elsewhere = lite
    page.goto(f"{address}/notebooks/{chapter}.html")
    page.goto(page.locator(".dropdown-launch-buttons a").first.evaluate("link => link.href"))
    page.wait_for_function(READY)
    found = nbformat.reads(page.evaluate(RUN, SECONDS), 4)
    install, *ran = code_cells(found)
    stored = code_cells(nbformat.read(NOTEBOOKS / f"{chapter}.ipynb", 4))
    assert said(install) == []
    assert [cell.execution_count for cell in ran] == list(range(2, len(stored) + 2))
    for cell, before in zip(ran, stored, strict=True):
        assert said(cell) == said(before), before.source
    prose = [cell.source for cell in found.cells if cell.cell_type == "markdown"]
    assert not list(filter(MYST.search, prose))
    if any(text.startswith("Explorer(") for cell in stored for _, text in said(cell)):
        assert_a_menu_leads_to_another_picture(page)
    assert elsewhere == []


def assert_a_menu_leads_to_another_picture(page):
    """In the first explorer of a notebook, by way of the kernel."""
    page.evaluate(SCROLL)
    explorer = page.locator(".jp-OutputArea-output", has=page.locator(".mesh-explorer")).first
    title, menu = explorer.locator(".title"), explorer.locator("select").first
    before = title.text_content()
    menu.select_option(index=1)
    page.wait_for_function(OTHER_TEXT, arg=[title.element_handle(), before])
