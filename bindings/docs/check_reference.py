#!/usr/bin/env python3
"""Counts the symbols of the C interface that have no words in Doxygen's XML: also values of enums, parameters and results.

A parameter needs no @param if its type is one of Dartsweep's, or if the comment of its function, of its header or of base.h (which tells
what all functions share) has its name `in code`. A function that returns dsw_status needs no @return: base.h lists the common statuses.
Usage: check_reference.py FOLDER_OF_XML
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree

PARTS = ("compounddef", "memberdef", "enumvalue")
NO_INTERFACE = ("dir", "page")


def text_of(element):
    return "".join(element.itertext()).strip()


def has_text(element, *names):
    return any(text_of(part) for name in names for part in element.findall(name))


def in_code(element):
    """Names that the comments below an element have `in code`."""
    return {text_of(part) for part in element.iter("computeroutput")}


def undocumented(folder):
    """Names, each once; and how many there are in all."""

    def in_header(path):
        return in_code(ElementTree.parse(path).find("compounddef/detaileddescription"))

    everywhere = in_header(folder / "base_8h.xml")
    missing, seen = set(), set()
    for path in sorted(folder.glob("*.xml")):
        shared = everywhere | (in_header(path) if path.stem.endswith("_8h") else set())
        for element in ElementTree.parse(path).iter():
            if element.tag not in PARTS or element.get("kind") in NO_INTERFACE:
                continue
            name = element.findtext("compoundname") or element.findtext("qualifiedname") or element.findtext("name")
            seen.add(element.get("id"))
            if not has_text(element, "briefdescription", "detaileddescription"):
                missing.add(name)
            if element.get("kind") == "function":
                told = shared | in_code(element) | {part.text for part in element.iter("parametername")}
                for parameter in element.findall("param"):
                    if "dsw_" not in text_of(parameter.find("type")):
                        missing.update(f"{name}: {left}" for left in {parameter.findtext("declname")} - told - {None})
                if (text_of(element.find("type")) not in ("void", "dsw_status")
                        and element.find(".//simplesect[@kind='return']") is None):
                    missing.add(f"{name}: what it returns")
    return sorted(missing), len(seen)


names, total = undocumented(pathlib.Path(sys.argv[1]))
print(*names, f"abi.undocumented_symbols {len(names)}", sep="\n")
sys.exit(bool(names) or total < 500)
