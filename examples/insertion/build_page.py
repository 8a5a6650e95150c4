#!/usr/bin/env python3
"""Makes the page of an insertion: build_page.py INPUT.json OUTPUT.html [--build FOLDER] [--with-tests]

INPUT.json is what the insertion program has written; OUTPUT.html needs no other file and no network. Libraries are installed in
FOLDER, by default build/page; --with-tests installs what the tests of the page need, too. Exit code 1, with a message, if the
input can't be used or the page can't be made.
"""
import argparse
import array
import base64
import json
import math
import os
import sys

import bundle

HERE = os.path.dirname(os.path.abspath(__file__))
CODES = {"float32": "f", "float64": "d", "uint8": "B", "uint16": "H", "uint32": "I", "int32": "i"}


def packed(kind, values):
    """A typed array of the page: far shorter than numbers in JSON."""
    numbers = array.array(CODES[kind], values)
    if sys.byteorder == "big":
        numbers.byteswap()
    return {"type": kind, "base64": base64.b64encode(numbers.tobytes()).decode()}


def indices(values):
    values = list(values)
    return packed("uint16" if max(values, default=0) < 1 << 16 else "uint32", values)


def finite(value):
    """NaN and infinities, which JSON has no words for, become null: a gap in a chart, a dash in a table."""
    if isinstance(value, dict):
        return {key: finite(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [finite(entry) for entry in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def offsets(groups):
    """Where each group begins in their concatenation, and its end."""
    sums = [0]
    for group in groups:
        sums.append(sums[-1] + len(group))
    return packed("uint32", sums)


def check(insertion):
    """What the page relies on; raises ValueError."""
    wall, frames, series = insertion["wall"], insertion["frames"], insertion["series"]
    if insertion["format"] != 1:
        raise ValueError(f"format {insertion['format']!r} is not 1")
    insertion["title"].encode()  # raises UnicodeEncodeError, a ValueError, for half a character
    if not frames or not wall["triangles"]:
        raise ValueError("no frames or no wall")
    if len(wall["positions"]) % 3 or len(wall["triangles"]) % 3 or any(len(frame["positions"]) % 3 for frame in frames):
        raise ValueError("positions or triangles are not triples")
    if not 0 <= min(wall["triangles"]) <= max(wall["triangles"]) < len(wall["positions"]) // 3:
        raise ValueError("a triangle of the wall has a vertex that is not there")
    if any(not 0 <= index < len(frame["positions"]) // 3 for frame in frames for index in frame["inserted"]):
        raise ValueError("an inserted vertex is not in its frame")
    wrong = [name for name, values in series.items() if len(values) != len(frames)]
    if wrong or "time" not in series:
        raise ValueError(f"series without one entry a frame: {', '.join(wrong) or 'time'}")


def pack(insertion):
    """The data of the page. Positions count from `origin`, the middle of the wall, so that single precision costs a part in 10^7
    of the wall's size wherever it lies; contacts keep what the input says, in double precision. Raises ValueError,
    KeyError or TypeError if the input is not as agreed."""
    check(insertion)
    wall, frames = insertion["wall"], insertion["frames"]
    axes = [wall["positions"][axis::3] for axis in range(3)]
    origin = [(min(axis) + max(axis)) / 2 for axis in axes]

    def centred(positions):
        return [value - origin[at % 3] for at, value in enumerate(positions)]

    lines = [frame["positions"] for frame in frames]
    contacts = [contact for frame in frames for contact in frame["contacts"]]
    kinds = list(dict.fromkeys(["plane", "edge", "vertex"] + [contact["kind"] for contact in contacts]))
    return {
        **finite({key: insertion[key] for key in ("format", "title", "unit", "dt", "environment", "summary", "series")}),
        "series_about": insertion.get("series_about", {}),
        "contact_table": finite(insertion["contact_table"]),
        "origin": origin,
        "wall": {"positions": packed("float32", centred(wall["positions"])), "triangles": indices(wall["triangles"])},
        "frames": {
            "step": packed("uint32", [frame["step"] for frame in frames]),
            "time": packed("float64", [frame["time"] for frame in frames]),
            "first_coordinate": offsets(lines),
            "positions": packed("float32", [value for line in lines for value in centred(line)]),
            "first_inserted": offsets([frame["inserted"] for frame in frames]),
            "inserted": indices(index for frame in frames for index in frame["inserted"]),
            "first_contact": offsets([frame["contacts"] for frame in frames]),
        },
        "contacts": {
            "kinds": kinds,
            "kind": packed("uint8", [kinds.index(contact["kind"]) for contact in contacts]),
            "point": packed("float64", [value for contact in contacts for value in contact["point"]]),
            "normal": packed("float64", [value for contact in contacts for value in contact["normal"]]),
            "time": packed("float64", [contact["time"] for contact in contacts]),
            "tag": packed("float64", [contact["tag"] for contact in contacts]),
            "vertex": packed("int32", [contact["vertex"] for contact in contacts]),
            "impulse": packed("float64", [contact["impulse"] for contact in contacts]),
        },
    }


def main():
    parser = argparse.ArgumentParser(description="Makes one HTML file of an insertion.")
    parser.add_argument("input", help="insertion.json")
    parser.add_argument("output", help="the page")
    parser.add_argument("--build", default=os.path.join(HERE, "..", "..", "build", "page"), metavar="FOLDER",
                        help="where libraries are installed (build/page)")
    parser.add_argument("--with-tests", action="store_true", help="install what the tests of the page need, too")
    given = parser.parse_args()
    try:
        with open(given.input, encoding="utf-8") as file:
            data = pack(json.load(file))
    except (OSError, ValueError, KeyError, TypeError, AttributeError, OverflowError) as error:
        bundle.fail(f"cannot use '{given.input}': {type(error).__name__}: {error}")
    try:
        page = bundle.build(os.path.join(HERE, "page"), os.path.realpath(given.build), data["title"], data, given.with_tests)
        with open(given.output, "w", encoding="utf-8", newline="\n") as file:
            file.write(page)
    except (OSError, bundle.BundleError) as error:
        bundle.fail(str(error))
    print(f"wrote {given.output}, {os.path.getsize(given.output) / 1e6:.1f} MB, {len(data['series']['time'])} frames")


if __name__ == "__main__":
    main()
