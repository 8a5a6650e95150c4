"""Puts charts, tables and words into one HTML file that needs nothing else."""
import base64
from pathlib import Path

import jinja2
from markupsafe import Markup

import catalogue
import dials
from draw import spoken
from style import THEME, power, seconds
from svg import inline


def data_link(text, kind):
    """A file as an address that holds it."""
    return f"data:{kind};charset=utf-8;base64,{base64.b64encode(text.encode()).decode()}"


def chart(svg, name, title, csv_path):
    """What the template needs of one chart: the picture, and the same and its figures as downloads."""
    return {"name": name, "svg": Markup(inline(svg, name, title)), "svg_link": data_link(svg, "image/svg+xml"),
            "csv_name": csv_path.name, "csv_link": data_link(csv_path.read_text(encoding="utf-8"), "text/csv")}


def describe_curve(curve, svg):
    """What the template needs of one curve."""
    title = catalogue.title_of(curve.name)
    rows = [{"method": point.method, "role": point.role, "setting": point.label, "time": f"{seconds(point.seconds)} per {point.item}",
             "error": point.error_name, "value": spoken(point), "count": f"{point.count:,}", "note": point.note} for point in curve.points]
    return {"title": title, "about": catalogue.about(curve.name), "advice": catalogue.in_words(curve.advice), "rows": rows, "points": curve.setting_count,
            "errors": [panel.error_name for panel in curve.panels()], "peers": curve.peers, **chart(svg, curve.name, title, curve.csv)}


def describe_dials(drawn):
    """What the template needs of the list of dials; `drawn` are the curves of the page."""
    return [{"name": dial.name, "kind": dial.kind, "what": dial.what, "title": catalogue.title_of(dial.what), "drawn": dial.what in drawn}
            for dial in dials.read()]


def short(value):
    """A number of a table: whole ones as they are, others short, none as a dash."""
    if value is None or value != value:
        return "–"
    if value == int(value) and abs(value) < 1e7:
        return f"{int(value):,}"
    return power(value)


def render(**parts):
    """The page. `parts` are the names that the template uses."""
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(Path(__file__).parent), autoescape=True,
                                     undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(short=short, words=lambda name: name.replace("_", " "))
    light = "".join(f"--{name}:{pair[0]};" for name, pair in THEME.items())
    dark = "".join(f"--{name}:{pair[1]};" for name, pair in THEME.items())
    return environment.get_template("page.html").render(light=Markup(light), dark=Markup(dark), **parts)
