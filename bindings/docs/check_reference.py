#!/usr/bin/env python3
"""Counts the symbols of the C interface that have no words in Doxygen's XML: also values of enums, parameters and results.

A parameter needs no @param if its type is one of Dartsweep's, or if the comment of its function, of its header or of base.h (which tells
what all functions share) has its name `in code`. A function that returns dsw_status needs no @return: base.h lists the common statuses. A
member needs no words of its own if the comment of its struct or of its header has its name `in code`, or if it is one that base.h describes
for all structs; nor does a function that ends with _init. Enumerators that only fix a size mean nothing.
Usage: check_reference.py FOLDER_OF_XML
"""

import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

PARTS = ("compounddef", "memberdef", "enumvalue")
NO_INTERFACE = ("dir", "page")
OF_ALL_STRUCTS = re.compile(r"struct_size|reserved|flags|point_stride_bytes|\w+_count")


def text_of(element):
    return "".join(element.itertext()).strip()


def has_text(element, *names):
    return any(text_of(part) for name in names for part in element.findall(name))


def in_code(element):
    """Names that the comments below an element have `in code`."""
    return {text_of(part) for part in element.iter("computeroutput")}


def in_words(compound):
    """Names that the comment of a header or a struct has `in code`."""
    return {name for part in ("briefdescription", "detaileddescription") for name in in_code(compound.find(part))}


def undocumented(folder):
    """Names, each once; and how many there are in all."""

    def in_header(path):
        return in_words(ElementTree.parse(path).find("compounddef"))

    def in_own_header(compound):
        location = compound.find("location")
        header = folder / (pathlib.Path(location.get("file", "")).name.replace(".", "_8") + ".xml") if location is not None else folder
        return in_header(header) if header.is_file() else set()

    def is_told(element, names):
        name = element.findtext("name") or ""
        if element.tag == "enumvalue":
            return name.endswith("_FORCE_INT32")
        if element.get("kind") == "function":
            return name.endswith("_init")
        return element.get("kind") == "variable" and (name in names or OF_ALL_STRUCTS.fullmatch(name) is not None)

    everywhere = in_header(folder / "base_8h.xml")
    missing, seen = set(), set()
    for path in sorted(folder.glob("*.xml")):
        shared = everywhere | (in_header(path) if path.stem.endswith("_8h") else set())
        compound = ElementTree.parse(path).find("compounddef")
        names = set()
        if compound is not None and compound.get("kind") == "struct":
            names = in_own_header(compound) | in_words(compound)
        for element in ElementTree.parse(path).iter():
            if element.tag not in PARTS or element.get("kind") in NO_INTERFACE:
                continue
            name = element.findtext("compoundname") or element.findtext("qualifiedname") or element.findtext("name")
            seen.add(element.get("id"))
            if not has_text(element, "briefdescription", "detaileddescription") and not is_told(element, names):
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
