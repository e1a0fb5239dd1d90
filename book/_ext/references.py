"""A notebook in the plain Markdown of JupyterLab, which does not know MyST.

A cross-reference becomes the words that the page has for it, and leads to the notebook of
the other chapter; definitions, theorems and boxes become paragraphs between two lines; and
a figure gets its number and caption below.
"""

import re
from functools import lru_cache

import nbformat
from docutils import nodes
from sphinx import addnodes

ROLES = {
    "ref": ("std", "ref"),
    "numref": ("std", "numref"),
    "doc": ("std", "doc"),
    "eq": ("math", "eq"),
    "prf:ref": ("prf", "ref"),
    "cite": ("cite", "p"),
}
ROLE = re.compile(r"\{(" + "|".join(ROLES) + r")\}`([^`]+)`")
EXPLICIT = re.compile(r"(.+?)\s*<(.+)>", re.DOTALL)
DIRECTIVE = re.compile(r"^(`{3,})\{([a-z:]+)\} *(.*)\n((?::.*\n)*)((?:.*\n)*?)\1$", re.MULTILINE)
LABEL_OPTION = re.compile(r"^:label: (\S+)$", re.MULTILINE)
LABEL = re.compile(r"^\([\w-]+\)=\n", re.MULTILINE)
EQUATION_LABEL = re.compile(r"\$\$ *\(([\w-]+)\)")
TERM = re.compile(r"^(\S.*)\n: +", re.MULTILINE)


class Plain:
    """Markdown of the page `docname`, as JupyterLab understands it."""

    def __init__(self, app, docname):
        self.app, self.docname = app, docname

    def notebook(self, notebook):
        """The notebook with plain cells of text, and captions below its figures."""
        cells = []
        for cell in notebook.cells:
            if cell.cell_type == "markdown":
                cell.source = self.text(cell.source)
            cells.append(cell)
            if figure := cell.metadata.get("mystnb", {}).get("figure"):
                caption = f"*{self.words('numref', figure['name'])}.* {self.text(figure['caption'])}"
                cells.append(nbformat.v4.new_markdown_cell(caption, id=f"caption-{figure['name']}"))
        notebook.cells = cells
        return notebook

    def text(self, source):
        """MyST as plain Markdown."""
        source = DIRECTIVE.sub(self._directive, source)
        source = TERM.sub(r"**\1.** ", LABEL.sub("", source))
        source = EQUATION_LABEL.sub(lambda m: rf"\tag{{{self.words('eq', m[1]).strip('()')}}} $$", source)
        return ROLE.sub(lambda m: self._link(m[1], m[2]), source)

    def _directive(self, match):
        """A paragraph with a bold beginning, between two lines; a heading if it has no body."""
        _, name, title, options, body = match.groups()
        label = LABEL_OPTION.search(options)
        kind = self.words("prf:ref", label[1]) if label else name.removeprefix("prf:").capitalize()
        title = (f"{kind} ({title})" if title else kind) if name.startswith("prf:") else title
        body = self.text(body).strip()
        return f"---\n\n**{title}.**\n\n{body}\n\n---" if body else f"**{title}**"

    def _link(self, role, target):
        words, page = self._resolved(role, target)
        chapter = page.removesuffix(".html")
        return f"[{words}]({chapter}.ipynb)" if page and "/" not in page else words

    def words(self, role, target):
        """What the page shows for a reference."""
        return self._resolved(role, target)[0]

    @lru_cache  # noqa: B019, lives as long as the page is read
    def _resolved(self, role, target):
        """Words of a reference, and the page that it leads to: none if it is this page."""
        domain, kind = ROLES[role]
        title, target = match.groups() if (match := EXPLICIT.fullmatch(target)) else ("", target)
        node = addnodes.pending_xref(
            "", refdomain=domain, reftype=kind, reftarget=target, refdoc=self.docname, refexplicit=bool(title)
        )
        env, content = self.app.env, nodes.inline("", title or target)
        found = env.get_domain(domain).resolve_xref(
            env, self.docname, self.app.builder, kind, target, node, content
        )
        link = next(found.findall(nodes.reference))
        return found.astext(), link.get("refuri", "").partition("#")[0]
