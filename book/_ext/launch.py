"""The rocket menu of a chapter: the places where its notebook can run.

JupyterLite is part of the site.  Binder and Colab start from the repository and are
shown once its address is known, as ``launch_repository`` in ``_config.yml``.
"""

from urllib.parse import quote

from wheels import REQUIREMENT

LITE = "lite/notebooks/index.html?path="
BINDER = "https://mybinder.org/v2/git/"
COLAB = "https://colab.research.google.com/github/"
CODE_HOST_OF_COLAB = "https://github.com/"


def add_launch_menu(app, pagename, templatename, context, doctree):
    """Put the menu before the other buttons of a page that is a notebook."""
    notebook = f"{pagename}.ipynb"
    if not (doctree and (app.srcdir / notebook).exists()):
        return
    entries = [
        entry(
            "Browser",
            context["pathto"](LITE + notebook, 1),
            "jupyterlite.svg",
            "Run this chapter here, as real Python in the browser",
        ),
        *hosted(app.config.launch_repository.rstrip("/"), app.config.launch_branch, notebook),
    ]
    context["header_buttons"].insert(
        0,
        {
            "type": "group",
            "label": "launch-buttons",
            "icon": "fas fa-rocket",
            "tooltip": "Run this chapter",
            "buttons": entries,
        },
    )


def hosted(repository, branch, notebook):
    """Entries of the services that start from a repository; none if the address is unknown."""
    if repository:
        yield entry(
            "Binder",
            f"{BINDER}{quote(repository, safe='')}/{branch}?urlpath=lab/tree/{notebook}",
            "binder.svg",
            "Run this chapter on Binder, in the environment of the repository",
        )
    if repository.startswith(CODE_HOST_OF_COLAB):
        name = repository.removeprefix(CODE_HOST_OF_COLAB)
        yield entry(
            "Colab",
            f"{COLAB}{name}/blob/{branch}/{notebook}",
            "colab.png",
            f"Run this chapter on Colab, first of all: %pip install '{REQUIREMENT} @ git+{repository}'",
        )


def entry(text, url, logo, tooltip):
    """One line of the menu."""
    return {
        "type": "link",
        "text": text,
        "url": url,
        "tooltip": tooltip,
        "icon": f"_static/images/logo_{logo}",
    }


def setup(app):
    """Register the settings and the menu, after the theme has made its buttons."""
    app.add_config_value("launch_repository", "", "html", [str])
    app.add_config_value("launch_branch", "main", "html", [str])
    app.connect("html-page-context", add_launch_menu, priority=502)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
