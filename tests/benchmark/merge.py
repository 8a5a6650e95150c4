#!/usr/bin/env python3
"""Puts the figures of all parts into one flat object: merge.py OUT LIBRARY EDITS NORMALS TOGETHER DEFORM NEAR PART...

Adds core.needed_libraries: what the dynamic section of LIBRARY names beyond the C and C++ runtimes, and
topology.*, contact.normal_*, together.*, near.phantom and near.missed: what the tests say of random changes in EDITS, of
libccd's cross-checks in NORMALS, of moves in which all vertices go at once in TOGETHER and DEFORM, and of near rows in NEAR. These are reports as GoogleTest writes
them."""
import json
import re
import subprocess
import sys

RUNTIMES = re.compile(r"(libc|libm|libpthread|libdl|librt|libgcc_s|libstdc\+\+|libc\+\+|libc\+\+abi|ld-linux.*)\.so")


def read_report(path):
    with open(path, encoding="utf-8") as file:
        report = json.load(file)
    return report, [test for suite in report["testsuites"] for test in suite["testsuite"]]


def main():
    out, library, edits, normals, together, deform, near, rays, *parts = sys.argv[1:]
    figures = {}
    for part in parts:
        with open(part, encoding="utf-8") as file:
            content = json.load(file)
            if "testsuites" in content:  # of GoogleTest: properties that are figures
                content = {name: float(value) for test in read_report(part)[1] for name, value in test.items() if name.startswith("contact.")}
            for name, value in content.items():
                if isinstance(value, bool) or not isinstance(value, (int, float)):
                    raise SystemExit(f"{part}: {name} is not a number")
                if name in figures:
                    raise SystemExit(f"{part}: {name} was reported before")
                figures[name] = value
    report, tests = read_report(edits)
    figures["topology.random_ops"] = sum(int(test.get("changes", 0)) for test in tests)
    figures["topology.violations"] = report["failures"] + report["errors"]
    asked = [test for test in read_report(normals)[1] if "cross_checks" in test]
    if asked:
        figures["contact.normal_vs_libccd_deg_p99"] = max(float(test["deg_p99"]) for test in asked)
        cross_checks = sum(int(test["cross_checks"]) for test in asked)
        figures["contact.normal_qualified_share"] = cross_checks / sum(int(test["contacts"]) for test in asked)

    def sum_of(tests, name):
        return sum(int(test.get(name, 0)) for test in tests)

    moved = read_report(together)[1] + read_report(deform)[1]
    figures["together.property_moves"] = sum_of(moved, "moves")
    figures["together.missed"] = sum_of(moved, "missed")
    figures["together.not_free_after"] = sum_of(moved, "not_free")
    figures["together.numbering_changes_result"] = sum_of(moved, "different")
    shares = [float(test["motion_made_share"]) for test in moved if "motion_made_share" in test]
    if shares:
        figures["together.motion_made_share"] = min(shares)
    seen = read_report(near)[1]
    figures["near.rows_checked"] = sum_of(seen, "rows")
    figures["near.phantom"] = sum_of(seen, "phantom")
    figures["near.missed"] = sum_of(seen, "missed")
    seen = read_report(rays)[1]
    figures["rays.casts_checked"] = sum_of(seen, "casts")
    figures["rays.missed"] = sum_of(seen, "missed")
    figures["rays.phantom"] = sum_of(seen, "phantom")
    figures["threads.cuts_checked"] = sum_of(seen, "thread_cuts")
    figures["threads.wrong"] = sum_of(seen, "threads_wrong")
    figures["threads.not_free"] = sum_of(seen, "threads_not_free")
    figures["freed.bodies_checked"] = sum_of(seen, "penetrating")
    figures["freed.shallow"] = sum_of(seen, "shallow")
    figures["freed.share"] = sum_of(seen, "shallow_freed") / max(1, sum_of(seen, "shallow"))
    figures["freed.share_of_all"] = sum_of(seen, "freed") / max(1, sum_of(seen, "penetrating"))
    figures["freed.crossed_after"] = sum_of(seen, "crossed_after")
    figures["freed.untold"] = sum_of(seen, "penetrations_untold")
    figures["exits.moves_checked"] = sum_of(seen, "exit_moves")
    figures["exits.wrong"] = sum_of(seen, "exits_wrong")
    figures["signed_distance.points_checked"] = sum_of(seen, "signs")
    figures["signed_distance.wrong_signs"] = sum_of(seen, "wrong_signs")
    figures["sight.pairs_checked"] = sum_of(seen, "pairs")
    figures["sight.wrong"] = sum_of(seen, "wrong")
    dynamic = subprocess.run(["readelf", "-d", library], check=True, capture_output=True, text=True).stdout
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", dynamic)
    figures["core.needed_libraries"] = sum(1 for name in needed if not RUNTIMES.match(name))
    with open(out, "w", encoding="utf-8") as file:
        json.dump(figures, file, indent=1)
        file.write("\n")


main()
