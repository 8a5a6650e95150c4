"""Sphinx: this folder's pages, and every README of the project where it stands."""

import pathlib
import re

import dartsweep

ROOT = pathlib.Path(__file__).parents[2]

project = "Dartsweep"
version = release = dartsweep.__version__
root_doc = "bindings/docs/index"
include_patterns = ["bindings/docs/*.md", "CHANGELOG.md", "README.md", "*/README.md", "*/**/README.md"]
exclude_patterns = ["build*", "out", ".*", "**/.*", "**/node_modules", "tests/fuzz/corpus"]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
html_theme = "furo"
html_title = f"Dartsweep {version}"
html_copy_source = html_show_sourcelink = html_show_sphinx = html_show_copyright = False

myst_enable_extensions = ["colon_fence", "deflist"]
myst_heading_anchors = 3
myst_url_schemes = {"http": None, "https": None, "c": "../../c/{{path}}"}  # pages of the C reference, from this folder
autodoc_member_order = "bysource"
autodoc_type_aliases = {name: name for name in ("ArrayLike", "IdOrIds", "Ids", "Records")}  # as they are written
default_role = "code"
nitpick_ignore_regex = [("py:.*", r"(?!dartsweep).*"), ("py:class", r".*\.Description|dartsweep\._core\..*")]  # not ours; a type variable; structs are told by the C reference


def name_pages_of_folders(app, docname, source):
    """A link to a folder becomes one to its README, or to the page that stands for it; links to other folders go, their words stay."""
    here = (ROOT / docname).parent

    def replace(link):
        words, target = link.groups()
        folder = (here / target).resolve()
        if not folder.is_dir():
            return link[0]
        for page in ("README.md", "index.md"):
            if (folder / page).exists():
                return f"[{words}]({target.rstrip('/')}/{page})"
        page = {"include/dartsweep": "c", "examples/c": "c_examples"}.get(str(folder.relative_to(ROOT)))
        return f"[{words}](/bindings/docs/{page}.md)" if page else words

    source[0] = re.sub(r"(?<!!)\[([^]\n]+)\]\(([^):#\s]+)\)", replace, source[0])


def name_types(app, what, name, obj, options, arguments, answer):
    """Types of arrays as the sources have them, instead of what they stand for."""

    def short(text):
        text = re.sub(r"TypeAliasForwardRef\('(\w+)'\)", r"\1", text)
        return re.sub(r"~?numpy\.ndarray\[tuple\[~?int, \.\.\.\], ~?numpy\.dtype\[~?(?:numpy\.)?(\w+)\]\]", r"NDArray[\1]", text)

    return (short(arguments), answer and short(answer)) if arguments else None


def setup(app):
    app.connect("autodoc-process-signature", name_types)
    app.connect("source-read", name_pages_of_folders)
