"""Figures as SVG: documents on their own, and parts of the page."""
import html
import io
import re

from style import THEME

import matplotlib.pyplot as plt


def to_svg(figure, tips, title):
    """A figure as an SVG document on its own; closes it. Marks with words show them under the pointer."""
    buffer = io.StringIO()
    figure.savefig(buffer, format="svg", metadata={"Date": None, "Creator": None, "Title": title})
    plt.close(figure)
    svg = buffer.getvalue()
    for tip, words in tips.items():
        svg = svg.replace(f'<g id="{tip}">', f'<g id="{tip}">\n    <title>{html.escape(words)}</title>')
    return svg


def inline(svg, name, title):
    """Makes of an SVG document a part of the page: without prologue, with ids of its own, with colours by name so that they follow the theme."""
    svg = svg[svg.index("<svg"):]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.S)
    svg = re.sub(r'\bid="([^"]+)"', rf'id="{name}-\1"', svg)
    svg = re.sub(r'href="#([^"]+)"', rf'href="#{name}-\1"', svg)
    svg = re.sub(r"url\(#([^)]+)\)", rf"url(#{name}-\1)", svg)
    for key, (light, _) in THEME.items():
        svg = svg.replace(light, f"var(--{key})")
    svg = re.sub(r'<svg [^>]*?(viewBox="[^"]+")[^>]*>', rf'<svg \1 role="img" aria-label="{html.escape(title)}">', svg, count=1, flags=re.S)
    return svg
