"""Correct the pages that the theme writes, for screen readers and for faster loading.

Names that contradict the text of a button, and the role of a list without items, are removed
from the finished pages. The script of the icons, which is larger than a page, loads last.
"""

import re
from pathlib import Path

SEARCH = 'search-button-field search-button__button pst-js-only" title="Search"'
MENDED = {
    f'{SEARCH} aria-label="Search"': SEARCH,
    'data-mode="light" title="Light"': 'data-mode="light"',
    'data-mode="dark"  title="Dark"': 'data-mode="dark"',
    'data-mode="auto"  title="System Settings"': 'data-mode="auto"',
    '<summary aria-label="Toggle hidden content">': "<summary>",
    '<div role="list" class="citation-list">': '<div class="citation-list">',
    # The scroll spy follows the contents of the page; `.bd-toc-nav` would match all links.
    'data-bs-target=".bd-toc-nav"': 'data-bs-target="#pst-page-toc-nav"',
}
ICONS = re.compile(r'<script (src="[^"]*/fontawesome\.js)')


def mend(app, exception):
    """Correct all pages of a finished HTML build; JupyterLite beside them is left alone."""
    if exception or app.builder.format != "html":
        return
    for folder in (".", "book", "notebooks"):
        for path in Path(app.outdir, folder).glob("*.html"):
            mend_page(path)


def mend_page(path):
    """Correct one page; a page without these faults is not written."""
    before = after = path.read_text(encoding="utf-8")
    for wrong, right in MENDED.items():
        after = after.replace(wrong, right)
    after = ICONS.sub(r"<script defer \1", after)
    if after != before:
        path.write_text(after, encoding="utf-8")


def setup(app):
    """Register the step with Sphinx."""
    app.connect("build-finished", mend)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
