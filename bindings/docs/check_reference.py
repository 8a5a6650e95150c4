#!/usr/bin/env python3
"""Counts what of the C interface has no words in Doxygen's XML, values of enums and names of parameters included, which Doxygen's own
warnings leave out in part. Usage: check_reference.py FOLDER_OF_XML
"""

import pathlib
import sys
import xml.etree.ElementTree as ElementTree

PARTS = ("compounddef", "memberdef", "enumvalue")
NO_INTERFACE = ("dir", "page")


def has_text(element, *names):
    return any("".join(part.itertext()).strip() for name in names for part in element.findall(name))


def undocumented(folder):
    """Names, each once; and how many there are in all."""
    missing, seen = set(), set()
    for path in sorted(folder.glob("*.xml")):
        for element in ElementTree.parse(path).iter():
            if element.tag not in PARTS or element.get("kind") in NO_INTERFACE:
                continue
            name = element.findtext("compoundname") or element.findtext("qualifiedname") or element.findtext("name")
            seen.add(element.get("id"))
            if not has_text(element, "briefdescription", "detaileddescription"):
                missing.add(name)
            if element.get("kind") == "function":
                told = {part.text for part in element.iter("parametername")}
                parameters = {parameter.findtext("declname") for parameter in element.findall("param")} - {None}
                missing.update(f"{name}: {parameter}" for parameter in parameters - told)
                if element.findtext("type") != "void" and element.find(".//simplesect[@kind='return']") is None:
                    missing.add(f"{name}: what it returns")
    return sorted(missing), len(seen)


names, total = undocumented(pathlib.Path(sys.argv[1]))
print(*names, f"abi.undocumented_symbols {len(names)}", sep="\n")
sys.exit(bool(names) or total < 500)
