#!/usr/bin/env python3
"""Lays out the package for Unity: the sources, a plugin for each target, and a .meta file beside each file, by which Unity knows the file
and its platform. Identifiers in the .meta files follow from the paths, so that they stay. Usage: unity.py OUT SOURCES TARGET=PLUGIN..."""

import hashlib
import pathlib
import shutil
import sys

SYSTEMS = {"linux": ("Linux64", "Linux"), "win": ("Win64", "Windows"), "osx": ("OSXUniversal", "OSX")}
PROCESSORS = {"x64": "x86_64", "arm64": "ARM64"}
FOLDER = "folderAsset: yes\nDefaultImporter:\n  externalObjects: {}\n  userData:\n"
OTHER = "DefaultImporter:\n  externalObjects: {}\n  userData:\n"
SCRIPT = "MonoImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n  userData:\n"
DEFINITION = "AssemblyDefinitionImporter:\n  externalObjects: {}\n  userData:\n"
PACKAGE = "PackageManifestImporter:\n  externalObjects: {}\n  userData:\n"

here = pathlib.Path(__file__).parent
out = pathlib.Path(sys.argv[1])
sources = pathlib.Path(sys.argv[2])
plugins = dict(argument.split("=", 1) for argument in sys.argv[3:])


def plugin_importer(target: str) -> str:
    """Settings of a plugin that is for players and editors of one system and processor."""
    system, processor = target.split("-")
    player, editor = SYSTEMS[system]
    cpu = PROCESSORS[processor]
    never = [name for name, _ in SYSTEMS.values() if name != player]
    excluded = "".join(f"        Exclude {name}: 1\n" for name in never)
    return (
        "PluginImporter:\n  externalObjects: {}\n  serializedVersion: 2\n  iconMap: {}\n  executionOrder: {}\n  defineConstraints: []\n"
        "  isPreloaded: 0\n  isOverridable: 0\n  isExplicitlyReferenced: 0\n  validateReferences: 1\n  platformData:\n"
        f"  - first:\n      : Any\n    second:\n      enabled: 0\n      settings:\n        Exclude Editor: 0\n        Exclude {player}: 0\n{excluded}"
        "  - first:\n      Any:\n    second:\n      enabled: 0\n      settings: {}\n"
        f"  - first:\n      Editor: Editor\n    second:\n      enabled: 1\n      settings:\n        CPU: {cpu}\n        OS: {editor}\n"
        f"  - first:\n      Standalone: {player}\n    second:\n      enabled: 1\n      settings:\n        CPU: {cpu}\n  userData:\n"
    )


def importer(path: pathlib.Path) -> str:
    if path.is_dir():
        return FOLDER
    if path.parts[-3:-2] == ("Plugins",):
        return plugin_importer(path.parts[-2])
    if path.name == "package.json":
        return PACKAGE
    return {".cs": SCRIPT, ".asmdef": DEFINITION}.get(path.suffix, OTHER)


shutil.rmtree(out, ignore_errors=True)
shutil.copytree(here / "unity", out)
shutil.copytree(sources, out / "Runtime", dirs_exist_ok=True)
for target, plugin in plugins.items():
    folder = out / "Plugins" / target
    folder.mkdir(parents=True)
    shutil.copy2(plugin, folder)

for path in sorted(out.rglob("*")):
    name = path.relative_to(out)
    if name.parts[0].endswith("~") or path.suffix == ".meta":  # Unity leaves out folders like Samples~, which have files of their own
        continue
    identifier = hashlib.md5(f"com.dartsweep.dartsweep/{name.as_posix()}".encode()).hexdigest()
    path.with_name(path.name + ".meta").write_text(f"fileFormatVersion: 2\nguid: {identifier}\n{importer(path)}")
