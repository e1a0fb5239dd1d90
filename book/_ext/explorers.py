"""Put the explorers into the site: their scripts, and the states computed beforehand.

A cell with the tag ``explorer-NAME`` shows the picture of its explorer; where a browser
runs scripts, the explorer of that name takes its place.
"""

import base64
import gzip
import json
from pathlib import Path

import joblib
from sphinx.util import logging

from meshlib.explorer import atlas, scripts
from meshlib.thesis.explorers import ALL

TAG = "tag_explorer-"
SCRIPT, STYLES, FOLDER = "explorers.js", "explorers.css", "explorers"
WIDGETS = "application/vnd.jupyter.widget-state+json"  # longer than all the rest of a page
SLOW = ("approximation",)  # explorers whose states take seconds each, so that all cores share them
FIRST = 100  # priority of the scripts, before those of Sphinx, which have 200
LAST = 900  # priority of the listener, after those that add other scripts
EVERY = tuple(ALL.values())
logger = logging.getLogger(__name__)


def write(folder, explorations=EVERY):
    """Write the scripts and styles of explorers, and the states of some, into the folder of static files."""
    folder = Path(folder)
    (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    (folder / SCRIPT).write_text(scripts.classic(), encoding="utf-8")
    (folder / STYLES).write_text(scripts.styles(), encoding="utf-8")
    for exploration in explorations:
        name = exploration.name
        logger.info("computing the states of the explorer %r", name)
        pages = atlas.pages(exploration, parallel if name in SLOW else map)
        # without the time, so that equal states make equal files
        item = json.dumps([name, base64.b64encode(gzip.compress(pages, mtime=0)).decode()])
        # A script and not data, since pages opened from a file may load nothing else.
        (folder / FOLDER / f"{name}.js").write_text(f"(window.meshExplorers ||= []).push({item});\n")


def parallel(function, items):
    """Like `map`, on all cores."""
    return joblib.Parallel(n_jobs=-1, return_as="generator")(map(joblib.delayed(function), items))


def write_all(app):
    """Write the files of all explorers before the pages are made."""
    if app.builder.format == "html":
        write(Path(app.outdir) / "_static")


def load(app, page, template, context, doctree):
    """Have a page load what its explorers need, and nothing for widgets, which no page shows."""
    context["script_files"][:] = [
        script for script in context["script_files"] if script.attributes.get("type") != WIDGETS
    ]
    names = [name for name in ALL if TAG + name in context.get("body", "")]
    if names:
        app.add_css_file(STYLES)
        for file in (SCRIPT, *(f"{FOLDER}/{name}.js" for name in names)):
            # async: unpacked while the page is read, which other scripts hold up
            app.add_js_file(file, loading_method="async", priority=FIRST)


def setup(app):
    """Register both steps with Sphinx."""
    app.connect("builder-inited", write_all)
    app.connect("html-page-context", load, priority=LAST)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
