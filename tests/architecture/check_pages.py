#!/usr/bin/env python3
"""Checks that what pages name is there: relative links with their anchors, paths of this repository, and names of sources. In sources in C, C++,
SWIG and CMake it looks for paths of this repository.

usage: check_pages.py ROOT          judges all pages (*.md, *.html) and sources of ROOT
       check_pages.py --self-test   makes small bad trees and fails unless each is refused
Exit 0: sound; 1: every violation is named.

A path may begin at ROOT, in the folder of its page or in a folder above it. The name of a source, or of a folder with a slash behind it, may stand
for any of that name. A star, <words> and words in capital letters stand for any name, and {a,b} for each of both. What a build makes is not looked
for. CHANGELOG.md may name what was there once; its links must lead somewhere.
"""
import fnmatch
import os
import pathlib
import re

import judge

NEEDED = "README.md"
MADE = re.compile(r"(?:build|out)[\w-]*(?:/|$)|_core\.py$")
LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?[^)]*\)|^\[[^\]]+\]:\s*(\S+)|\b(?:href|src)=[\"']([^\"']*)[\"']", re.M)
PATH = re.compile(r"(?<![\w/.$}*-])(?:abi|bindings|examples|include|src|tests)/[\w./*<>{},+-]*[\w/*>}]")
SOURCE = re.compile(r"(?:`|<code>)((?:[\w.*-]+/)*(?:[\w*-][\w.*-]*\.(?:h|hpp|inl|c|cpp|i|py|sh|cmake|ini|md)|[\w*-]+/))(?:`|</code>)")
CODE = re.compile(r"<code>[^\n]*?</code>|`[^`\n]*`")
ELSEWHERE = re.compile(r"\w+:|[{/]|$")  # of the web, of a template, of nothing
JUDGED = re.compile(r"^(?!abi/clients/).*(?:\.(?:h|hpp|inl|c|cpp|i|cmake)|CMakeLists\.txt)$")


def patterns(path):
    """What `path` stands for, as patterns of fnmatch."""
    path = re.sub(r"<[^>]*>|(?<![A-Za-z])(?:[A-Z]|[A-Z]{2,}(?!\.))(?![A-Za-z])", "*", path).rstrip("/.")
    if match := re.search(r"\{([^{}]*)\}", path):
        return [one for word in match[1].split(",") for one in patterns(path[:match.start()] + word + path[match.end():])]
    return [path]


def anchors(text):
    """The anchors of the headings of a page in Markdown, as they are made on GitHub."""
    headings = re.findall(r"^#+\s+(.*?)\s*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings} | set(re.findall(r"\bid=\"([^\"]+)\"", text))


def violations(root):
    files = set(judge.files_of(root))
    known = files | {parent.as_posix() for file in files for parent in pathlib.PurePosixPath(file).parents}
    below = {"/" + path for path in known}

    def is_there(path, folders):
        wholes = [os.path.normpath(os.path.join(folder, path)) for folder in folders]
        return any(whole in known or "*" in whole and fnmatch.filter(known, whole) for whole in wholes)

    found = []
    for name in sorted(files):
        is_page = name.endswith((".md", ".html"))
        if not is_page and not JUDGED.search(name):
            continue
        text = (root / name).read_text()
        above = [parent.as_posix() for parent in pathlib.PurePosixPath(name).parents]

        def judge_all(pattern, is_sound, why, text=text):
            for match in pattern.finditer(text):
                word = match[match.lastindex or 0]
                if not is_sound(word):
                    found.append(f"{name}:{text.count(chr(10), 0, match.start()) + 1}: {word}: {why}")

        def leads_somewhere(link):
            target, _, anchor = link.partition("#")
            whole = os.path.normpath(os.path.join(above[0], target)) if target else name
            if ELSEWHERE.match(link) or MADE.match(whole):
                return True
            return whole in known and (not anchor or not whole.endswith(".md") or anchor in anchors((root / whole).read_text()))

        if name != "CHANGELOG.md":
            judge_all(PATH, lambda path: all(is_there(one, above) for one in patterns(path)), "no such file or folder")
        if is_page:
            without_code = CODE.sub(lambda code: " " * len(code[0]), text)  # which may look like a link
            judge_all(LINK, leads_somewhere, "no such file or heading", without_code)
        if is_page and name != "CHANGELOG.md":
            judge_all(SOURCE, lambda path: PATH.match(path) or MADE.match(path) or all(
                is_there(one, above) or fnmatch.filter(below, "*/" + one) for one in patterns(path)), "no such source or folder")
    return found


# Each tree breaks one rule once; the sound ones break none.
HEADING = "# Of `cells`, in two\n"
TREES = {
    "sound": ({NEEDED: "[cells](src/map/README.md#of-cells-in-two) [here](#top) [far](https://x.y/z) [made](build/a.html)\n## Top\n`src/map`, "
                       "`src/{map,map/README.md}`, `map/`, `src/X/README.md`, `build/src/x.cpp`; `walk.h`, `{{x}}`\n",
               "src/map/README.md": HEADING, "src/map/walk.h": "// See src/map/README.md.\n", "c.md": "`[&](x)` <code>[&](y)</code>\n",
               "CHANGELOG.md": "src/motion, `gone.h`\n", "a/b.html": '<a href="../src">x</a><img src="data:x"><a href="{{ y }}">'}, 0),
    "link": ({NEEDED: "[a](src/b.md)\n"}, 2),
    "link by name": ({NEEDED: "[a][b]\n\n[b]: c.md\n"}, 1),
    "picture": ({NEEDED: "![a](b.png)\n"}, 1),
    "link in a history": ({NEEDED: "", "CHANGELOG.md": "[a](b.md)\n"}, 1),
    "heading": ({NEEDED: "[a](b.md#of-cells)\n", "b.md": HEADING}, 1),
    "own heading": ({NEEDED: "[a](#b)\n" + HEADING}, 1),
    "html": ({NEEDED: "", "a.html": '<img src="b.png">\n'}, 1),
    "path": ({NEEDED: "`src/motion`\n"}, 1),
    "path in a command": ({NEEDED: "    tests/run.sh all\n"}, 1),
    "one of two": ({NEEDED: "src/{a,b}.h\n", "src/a.h": ""}, 1),
    "pattern": ({NEEDED: "src/*_avx.cpp\n", "src/a.cpp": ""}, 1),
    "source": ({NEEDED: "`walk.h`\n"}, 1),
    "source in a folder": ({NEEDED: "`map/walk.h`\n", "src/walk.h": ""}, 1),
    "folder": ({NEEDED: "`walk/`\n"}, 1),
    "comment": ({NEEDED: "", "src/a.cpp": "// tests/a\n"}, 1),
    "comment of a list": ({NEEDED: "", "a/CMakeLists.txt": "# bindings/a\n"}, 1),
}
judge.main(__doc__, violations, TREES, NEEDED, "pages name what is there")
