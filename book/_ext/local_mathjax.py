"""Copy MathJax into the site, so that its pages ask no other host for it.

The files come from the Python package that carries them; the setting
``mathjax_path`` in ``_config.yml`` points at the copy.
"""

from importlib.util import find_spec
from pathlib import Path
from shutil import copy2

# The page loads the first file; the folders serve its rarer commands and its
# spoken and tactile output, which MathJax asks for by relative address.
WANTED = [
    "tex-svg.js",
    "input/tex/extensions/*.js",
    "a11y/*.js",
    "sre/mathmaps/base.json",
    "sre/mathmaps/en.json",
    "sre/mathmaps/nemeth.json",
]


def copy_mathjax(app, exception):
    """Copy the wanted files under ``_static/mathjax`` of a finished HTML build."""
    if exception or app.builder.format != "html":
        return
    package = Path(find_spec("mathjax").origin).parent / "static" / "mathjax"
    source, target = package / "es5", Path(app.outdir) / "_static" / "mathjax"
    wanted = [path for pattern in WANTED for path in source.glob(pattern)]
    for path in wanted:
        copy = target / path.relative_to(source)
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy2(path, copy)
    copy2(package / "LICENSE", target)


def setup(app):
    """Register the copying step with Sphinx."""
    app.connect("build-finished", copy_mathjax)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
