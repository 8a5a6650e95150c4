"""What scripts have in common that judge the sources of a tree, or small bad trees with --self-test."""
import os
import pathlib
import re
import sys
import tempfile

MADE = re.compile(r"\.git|build.*|out|obj|bin|target|node_modules|__pycache__|\.\w+_cache")


def files_of(root):
    """The paths of all files of a tree, but for what builds make."""
    for folder, folders, names in os.walk(root):
        folders[:] = [name for name in folders if not MADE.fullmatch(name)]
        for name in names:
            yield pathlib.Path(folder, name).relative_to(root).as_posix()


def test_itself(violations, trees):
    """`trees`: name: (files by their paths, how many violations there are)."""
    for name, (files, expected) in trees.items():
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            found = violations(root)
        if len(found) != expected:
            sys.exit(f"tree '{name}': expected {expected} violations, found {found}")
    print(f"{len(trees)} trees judged as they should be")


def main(usage, violations, trees, needed, sound):
    """`needed`: a path that every tree to be judged has; `sound`: what is said of a tree without violations."""
    if len(sys.argv) != 2:
        sys.exit(usage)
    if sys.argv[1] == "--self-test":
        test_itself(violations, trees)
        return
    root = pathlib.Path(sys.argv[1])
    if not (root / needed).exists():
        sys.exit(f"{root} has no {needed}")
    found = violations(root)
    print("\n".join(found) if found else sound)
    sys.exit(1 if found else 0)
