#!/usr/bin/env python3
"""How large the library is with and without libccd: library_size.py FOLDER FIGURES SETTING:LIBRARY...

Writes library_size.csv (part,setting,text_bytes,data_bytes,stripped_bytes) to FOLDER, and left_out.json: FIGURES with these sizes."""
import csv
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path


def sizes_of(library):
    """Code and constants, data, and the file without symbols."""
    with tempfile.TemporaryDirectory() as folder:
        stripped = os.path.join(folder, "library.so")
        subprocess.run(["strip", "-o", stripped, library], check=True)
        table = subprocess.run(["size", stripped], check=True, capture_output=True, text=True).stdout
        text, data, bss = (int(word) for word in table.splitlines()[1].split()[:3])
        return {"text_bytes": text, "data_bytes": data + bss, "stripped_bytes": os.path.getsize(stripped)}


def main():
    folder, figures = Path(sys.argv[1]), json.loads(Path(sys.argv[2]).read_text())
    rows = []
    for argument in sys.argv[3:]:
        setting, library = argument.split(":", 1)
        rows.append({"part": "libccd", "setting": setting, **sizes_of(library)})
        for name in ("text_bytes", "data_bytes", "stripped_bytes"):
            figures[f"left_out.library.libccd_{setting.replace(' ', '_')}.{name}"] = rows[-1][name]
    with open(folder / "library_size.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    (folder / "left_out.json").write_text(json.dumps(figures, indent=1) + "\n")


main()
