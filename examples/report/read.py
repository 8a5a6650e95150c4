"""Reads what the measuring programs wrote. Whatever is wrong with a file is a BadFile, which names file, line and column."""
import csv
import json
import math
from dataclasses import dataclass, field
from pathlib import Path

from catalogue import in_words, is_exact, peer_of

CURVE_COLUMNS = ("curve", "method", "setting", "setting_unit", "seconds_per_item", "item", "error_name", "error",
                 "error_unit", "count", "note")
PROMISES = ("nonfinite", "not_free", "lost")
STABILITY_NUMBERS = ("stiffness", "dt", "stable", "energy_drift", "energy_largest", "largest_stretch", *PROMISES)
LEFT_OUT_NUMBERS = ("bytes_per_cell", "bytes_per_vertex", "orientation_tests_per_step", "microseconds_per_step")
PAIR_NUMBERS = ("queries", "touching", "missed", "invented", "late", "time_error", "time_off_median", "time_off_max", "ns_median", "ns_p999",
                "ns_max")
SIZE_NUMBERS = ("text_bytes", "data_bytes", "stripped_bytes")


class BadFile(Exception):
    """A file that can't be used; the message is for the user."""


@dataclass(frozen=True)
class Point:
    method: str
    setting: str
    setting_unit: str
    seconds: float  # per item, above 0
    item: str
    error_name: str
    error: float  # 0 or above
    error_unit: str
    count: int  # items behind the error
    note: str

    @property
    def role(self):
        """Who gave the answer: "peer", "exact" (no approximation) or "dial"."""
        if peer_of(self.method):
            return "peer"
        return "exact" if is_exact(self.method) else "dial"

    @property
    def is_share(self):
        """Whether the error is the share of cases that went wrong."""
        return self.error_name.startswith("share of ")

    @property
    def exploded(self):
        """Whether the physics did, so that the error says no more than that."""
        return self.note.startswith("explodes")

    @property
    def label(self):
        return f"{self.setting} {self.setting_unit}".strip()


@dataclass(frozen=True)
class Panel:
    """One kind of error of a curve."""

    error_name: str
    error_unit: str
    item: str
    points: tuple

    def series(self):
        """Points by method and what it sets, in the file's order: the dials first, then the exact methods, then the peers."""
        found = {}
        for point in sorted(self.points, key=lambda point: ("dial", "exact", "peer").index(point.role)):
            unit = f" [{point.setting_unit}]" if point.setting and point.setting_unit else ""
            found.setdefault(point.method + unit, []).append(point)
        return found


@dataclass(frozen=True)
class Curve:
    name: str
    points: tuple
    advice: str
    csv: Path = field(compare=False)

    def panels(self):
        found = {}
        for point in self.points:
            found.setdefault((point.error_name, point.error_unit, point.item), []).append(point)
        return [Panel(*key, tuple(points)) for key, points in found.items()]

    @property
    def setting_count(self):
        """Methods and settings that were measured."""
        return len({(point.method, point.label) for point in self.points})

    @property
    def peers(self):
        return sorted({peer_of(point.method) for point in self.points if point.role == "peer"})


def read_rows(path, columns, exactly=False):
    """(line number, row as a dict) of a CSV file whose heading holds `columns`."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            reader = csv.reader(file, strict=True)
            heading = next(reader, None)
            if not heading:
                raise BadFile(f"{path}: the file is empty, a heading is needed")
            absent = [name for name in columns if name not in heading]
            if absent or (exactly and tuple(heading) != tuple(columns)):
                wanted = f"the heading must be {','.join(columns)}" if exactly else f"no column {', '.join(absent)}"
                raise BadFile(f"{path}:1: {wanted}; it is {','.join(heading)}")
            rows = []
            for values in reader:
                if len(values) != len(heading):
                    raise BadFile(f"{path}:{reader.line_num}: {len(values)} values under {len(heading)} columns")
                rows.append((reader.line_num, dict(zip(heading, values))))
    except OSError as error:
        raise BadFile(f"{path}: {error.strerror}") from error
    except (csv.Error, UnicodeDecodeError) as error:
        raise BadFile(f"{path}: no CSV: {error}") from error
    if not rows:
        raise BadFile(f"{path}: a heading without rows")
    return rows


def number(path, line, row, column, least=None, above=None):
    try:
        value = float(row[column])
    except ValueError:
        value = math.nan
    if not math.isfinite(value) or (least is not None and value < least) or (above is not None and value <= above):
        bound = f" of at least {least}" if least is not None else f" above {above}" if above is not None else ""
        raise BadFile(f"{path}:{line}: {column} must be a finite number{bound}, not '{row[column]}'")
    return value


def read_curve(path):
    """One curve and its sentence of advice, from NAME.csv and NAME.txt."""
    path = Path(path)
    points = []
    for line, row in read_rows(path, CURVE_COLUMNS, exactly=True):
        for column in ("method", "item", "error_name"):
            if not row[column].strip():
                raise BadFile(f"{path}:{line}: {column} is empty")
        if row["curve"] != path.stem:
            raise BadFile(f"{path}:{line}: curve is '{row['curve']}' in the file of '{path.stem}'")
        count = number(path, line, row, "count", least=1)
        if count != int(count):
            raise BadFile(f"{path}:{line}: count must be a whole number, not '{row['count']}'")
        points.append(Point(
            in_words(row["method"].strip()), row["setting"].strip(), in_words(row["setting_unit"].strip().removeprefix("setting")),
            number(path, line, row, "seconds_per_item", above=0), row["item"].strip(), row["error_name"].strip(),
            number(path, line, row, "error", least=0), row["error_unit"].strip(), int(count), row["note"].strip()))
    text = path.with_suffix(".txt")
    try:
        advice = " ".join(text.read_text(encoding="utf-8").split())
    except OSError as error:
        raise BadFile(f"{text}: {error.strerror}; each curve needs a sentence that says which setting to pick") from error
    if not advice:
        raise BadFile(f"{text}: the sentence that says which setting to pick is empty")
    return Curve(path.stem, tuple(points), advice, path)


def read_curves(folder):
    """All curves of a folder: every CSV file but the tables, and the pairs that peers in other languages read."""
    tables = {"stability", "contact_stability", "extremes", "left_out", "library_size", "exact_pairs"}
    paths = [path for path in sorted(Path(folder).glob("*.csv")) if path.stem not in tables and not path.stem.startswith("pairs_")]
    if not paths:
        raise BadFile(f"{folder}: no curves: no CSV file in this folder")
    return [read_curve(path) for path in paths]


def read_stability(folder):
    """(rows of stability.csv, rows of extremes.csv, summary of stability.json), numbers as numbers."""
    folder = Path(folder)
    grid, extremes = [], []
    path = folder / "stability.csv"
    for line, row in read_rows(path, ("integrator", *STABILITY_NUMBERS)):
        for column in ("stiffness", "dt"):
            row[column] = number(path, line, row, column, above=0)
        for column in ("stable", *PROMISES):
            row[column] = number(path, line, row, column, least=0)
        for column in row.keys() - {"integrator", "stiffness", "dt", "stable", *PROMISES}:
            row[column] = float(row[column]) if row[column] else math.nan  # physics that exploded has no number here
        grid.append(row)
    path = folder / "extremes.csv"
    for line, row in read_rows(path, ("case", "steps", "contacts", "refused", "goes_on", *PROMISES)):
        for column in ("steps", "contacts", "refused", "goes_on", *PROMISES):
            row[column] = number(path, line, row, column, least=0)
        extremes.append(row)
    path = folder / "stability.json"
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))["summary"]
    except OSError as error:
        raise BadFile(f"{path}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise BadFile(f"{path}: no JSON object with a summary: {error}") from error
    for name in ("nonfinite", "not_free", "lost", "implicit_euler_max_stable_k"):
        if not isinstance(summary.get(name), (int, float)):
            raise BadFile(f"{path}: summary has no number {name}")
    return grid, extremes, summary


def read_left_out(folder):
    """Rows of left_out.csv and of library_size.csv, each none if there is no such file; empty numbers are None."""
    found = []
    for name, words, numbers in (("left_out", ("feature", "setting"), LEFT_OUT_NUMBERS), ("library_size", ("part", "setting"), SIZE_NUMBERS)):
        path, rows = Path(folder) / f"{name}.csv", []
        for line, row in read_rows(path, (*words, *numbers)) if path.exists() else ():
            for column in numbers:
                row[column] = number(path, line, row, column, least=0) if row[column] else None
            rows.append(row)
        found.append(rows)
    return found


def read_exact_pairs(folder):
    """(rows of exact_pairs.csv, figures of exact_pairs.json), both empty if there is no such file."""
    path = Path(folder) / "exact_pairs.csv"
    if not path.exists():
        return [], {}
    rows = []
    for line, row in read_rows(path, ("set", "kind", "method", *PAIR_NUMBERS)):
        for column in PAIR_NUMBERS:
            row[column] = number(path, line, row, column, least=0)
        rows.append(row)
    path = path.with_suffix(".json")
    try:
        figures = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise BadFile(f"{path}: {error.strerror}") from error
    except ValueError as error:
        raise BadFile(f"{path}: no JSON: {error}") from error
    return rows, figures
