#!/usr/bin/env python3
"""Checks the scenes without SOFA: XML, files that are read, names of our components, of their Data and links, links to other components, and
that meshes.py makes meshes whose tetrahedra are turned alike and share faces in pairs.

usage: check_scenes.py FOLDER    the folder of the plugin
Exit 0: sound; 1: every fault is named.
"""
import pathlib
import re
import sys
import tempfile
import xml.etree.ElementTree as tree

NAME = re.compile(r'init(?:Data|Link)\(\s*(?:&\w+,\s*(?:[^,()]|\([^()]*\))*?,?\s*)?"(\w+)"')
STANDARD = {"name", "template", "listening", "printLog", "tags"}


def components_of(sources):
    """For each component of the plugin, the names of its Data and links."""
    names = {path.stem: set(NAME.findall(path.read_text())) for path in sources.glob("*.cpp")}
    body = names["DartsweepBody"] | names["BaseBody"]
    return {name: found for name, found in names.items() if name.startswith("Dartsweep")} | {"DartsweepBody": body}


def nodes_of(path, folder):
    """The tree of a scene, with what it includes."""
    root = tree.parse(path).getroot()
    for parent in list(root.iter()):
        for k, child in enumerate(list(parent)):
            if child.tag == "include":
                parent.remove(child)
                parent.insert(k, nodes_of(folder / child.get("href"), folder))
    return root


def paths_of(node, prefix=""):
    """Paths of all named components."""
    for child in node:
        path = f"{prefix}/{child.get('name', '')}"
        yield path
        if child.tag == "Node":
            yield from paths_of(child, path)


def faults_of_scene(path, folder, meshes, components):
    root = nodes_of(path, folder)
    paths = set(paths_of(root))
    plugins = {name for node in root.iter("RequiredPlugin") for name in node.get("pluginName").split()}
    if "SofaDartsweep" not in plugins:
        yield "does not ask for SofaDartsweep"
    for node in root.iter():
        if node.get("filename") and not (meshes / pathlib.Path(node.get("filename")).name).exists():
            yield f"{node.get('filename')} is made by nobody"
        for key, value in node.attrib.items():
            if value.startswith("@/") and value[1:].split(".")[0] not in paths:
                yield f"{node.tag}.{key}: no component {value}"
        if not node.tag.startswith("Dartsweep"):
            continue
        if node.tag not in components:
            yield f"no component {node.tag}"
        else:
            yield from (f"{node.tag} has no {key}" for key in set(node.attrib) - components[node.tag] - STANDARD)


def volume(points, cell):
    a, b, c = ([points[cell[k]][axis] - points[cell[0]][axis] for axis in range(3)] for k in (1, 2, 3))
    return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6


def faults_of_mesh(path):
    words = path.read_text().split()
    count = int(words[words.index("POINTS") + 1])
    first = words.index("POINTS") + 3
    points = [tuple(map(float, words[first + 3 * k:first + 3 * k + 3])) for k in range(count)]
    first = words.index("CELLS") + 3
    cells = [tuple(map(int, words[first + 5 * k + 1:first + 5 * k + 5])) for k in range(int(words[first - 2]))]
    faces = {}
    for cell in cells:
        for k in range(4):
            face = tuple(sorted(cell[:k] + cell[k + 1:]))
            faces[face] = faces.get(face, 0) + 1
    flat = sum(volume(points, cell) <= 0 for cell in cells)
    if flat:
        yield f"{flat} of {len(cells)} tetrahedra are flat or inside out"
    if max(faces.values()) > 2:
        yield "a face belongs to three tetrahedra"


def main(folder):
    scenes = folder / "scenes"
    sys.path.insert(0, str(scenes))
    import meshes
    components, faults, seen = components_of(folder / "SofaDartsweep"), [], 0
    with tempfile.TemporaryDirectory() as made:
        made = pathlib.Path(made)
        meshes.main(made)
        for path in sorted(scenes.glob("*.scn")):
            seen += 1
            faults += [f"{path.name}: {fault}" for fault in faults_of_scene(path, scenes, made, components)]
        for path in sorted(made.glob("*.vtk")):
            faults += [f"{path.name}: {fault}" for fault in faults_of_mesh(path)]
    print("\n".join(faults) or f"{seen} scenes are sound")
    return 1 if faults or seen < 10 else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
