#!/usr/bin/env python3
"""Makes a NuGet package without NuGet: a zip file as the Open Packaging Conventions have it. Usage: pack.py NUSPEC FOLDER OUT"""

import pathlib
import sys
import xml.etree.ElementTree as xml
import zipfile

NUSPEC = "{http://schemas.microsoft.com/packaging/2011/08/nuspec.xsd}"
TYPES = "http://schemas.openxmlformats.org/package/2006/"

nuspec, folder, out = map(pathlib.Path, sys.argv[1:])
root = xml.parse(nuspec).getroot()
files = {nuspec.name: nuspec}
for entry in root.iter(NUSPEC + "file"):
    found = sorted(folder.glob(entry.attrib["src"].replace("**", "**/*")))
    if not found:
        sys.exit(f"{folder} has no {entry.attrib['src']}")
    above = folder / entry.attrib["src"].partition("*")[0] if "**" in entry.attrib["src"] else None  # what ** matches keeps its folders
    files |= {f"{entry.attrib['target']}/{path.relative_to(above or path.parent).as_posix()}": path for path in found if path.is_file()}
version = root.findtext(f"{NUSPEC}metadata/{NUSPEC}version")
name = root.findtext(f"{NUSPEC}metadata/{NUSPEC}id")
extensions = sorted({path.rpartition(".")[2] for path in files})
with zipfile.ZipFile(out / f"{name}.{version}.nupkg", "w", zipfile.ZIP_DEFLATED) as package:
    defaults = "".join(f'<Default Extension="{each}" ContentType="application/octet"/>' for each in extensions)
    package.writestr(
        "[Content_Types].xml",
        f'<Types xmlns="{TYPES}content-types"><Default Extension="rels" ContentType='
        f'"application/vnd.openxmlformats-package.relationships+xml"/>{defaults}</Types>',
    )
    package.writestr(
        "_rels/.rels",
        f'<Relationships xmlns="{TYPES}relationships"><Relationship Id="R1" Target="/{nuspec.name}" '
        'Type="http://schemas.microsoft.com/packaging/2010/07/manifest"/></Relationships>',
    )
    for path, source in files.items():
        package.write(source, path)
