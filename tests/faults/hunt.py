#!/usr/bin/env python3
"""Runs the tests of a build of plant.py's tree, and says which test finds which fault.

usage: hunt.py BUILD measure [OPTIONS]   runs every test without a fault: its processor time, and the faults that it reaches
       hunt.py BUILD hunt [OPTIONS]      the quickest tests first: which faults each finds that no test before found
       hunt.py BUILD report              tables of both
A fault is found by a test that fails, crashes, or takes far more time with it. A test runs with all faults that it reaches and that nobody
has found; if it fails, with halves of them, down to single faults. BUILD/hunt.json is written after every test: a run goes on where the
last one ended.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import resource
import subprocess
import tempfile
import threading
import time

LEFT_OUT = {"source", "package", "abi"}  # these look at sources and at what is installed


def cases_of(command, folder):
    """The cases of a program of GoogleTest that ctest runs as one test; none of another command."""
    if command[1:] != ["--gtest_brief=1"]:
        return []
    listed = subprocess.run([command[0], "--gtest_list_tests"], cwd=folder, check=True, capture_output=True, text=True).stdout
    cases, suite = [], ""
    for line in listed.splitlines():
        name = line.split("  # ")[0].rstrip()
        if line.startswith(" "):
            cases.append(suite + name.strip())
        else:
            suite = name
    return cases


class Tests:
    """What ctest would run, each case of a program by itself: commands by their names."""

    def __init__(self, build, programs):
        self.commands, self.settings = {}, {}
        if programs:
            self.read(programs, {"LD_LIBRARY_PATH": str(build / "src")})
        self.read(build, {})

    def read(self, build, settings):
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, check=True, capture_output=True, text=True).stdout
        for test in json.loads(listed)["tests"]:
            properties = {p["name"]: p["value"] for p in test.get("properties", ())}
            if "command" in test and os.path.exists(test["command"][0]) and not LEFT_OUT & set(properties.get("LABELS", ())):
                command, folder = test["command"], properties.get("WORKING_DIRECTORY", str(build))
                own = dict(v.split("=", 1) for v in properties.get("ENVIRONMENT", ()) if not v.startswith("GTEST_"))
                each = {case: [command[0], f"--gtest_filter={case}"] for case in cases_of(command, folder)}
                for name, line in (each or {test["name"]: command}).items():
                    self.commands[name] = (line, folder)
                    self.settings[name] = {**settings, **own}

    def program(self, name):
        return next((os.path.basename(part) for part in self.commands[name][0] if not part.endswith(("python3", "cmake"))), name)

    def run(self, name, faults, limit, reached=None):
        """(passed, seconds of processor). `limit`: seconds of processor; a test that waits for ever ends after a while, too."""
        command, folder = self.commands[name]
        environment = {**os.environ, **self.settings[name], "DSW_FAULTS": ",".join(map(str, faults))}
        if reached:
            environment["DSW_FAULTS_REACHED"] = reached

        def limits():
            os.setsid()
            resource.setrlimit(resource.RLIMIT_CPU, (int(limit) + 1, int(limit) + 1))
            resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        process = subprocess.Popen(command, cwd=folder, env=environment, preexec_fn=limits, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        start = time.monotonic()
        while True:
            pid, status, usage = os.wait4(process.pid, os.WNOHANG)
            if pid:
                process.returncode = os.waitstatus_to_exitcode(status)
                return process.returncode == 0, usage.ru_utime + usage.ru_stime
            lasted = time.monotonic() - start
            if lasted > 60 + 30 * limit:
                os.killpg(process.pid, 9)
            time.sleep(0.002 + min(lasted / 50, 0.05))


class Hunt:
    def __init__(self, build, programs, file, until):
        self.file = file or build / "hunt.json"
        self.tests = Tests(build, programs)
        faults = json.loads((build.parent.parent / "faults.json").read_text())
        self.faults = {f["number"]: f for f in faults["faults"]}
        self.state = json.loads(self.file.read_text()) if self.file.exists() else {}
        self.state.setdefault("measured", {})  # by test: seconds, reached faults
        self.state.setdefault("asked", {})     # by test: faults that were tried
        self.state.setdefault("found", {})     # by fault: test
        self.until = until
        self.lock = threading.Lock()

    def save(self):
        with self.lock:
            self.file.with_suffix(".new").write_text(json.dumps(self.state))
            self.file.with_suffix(".new").replace(self.file)

    def is_late(self):
        return time.time() > self.until

    def measure(self, pattern, limit, jobs):
        """A test that takes longer than the limit may reach every fault."""
        names = [n for n in self.tests.commands if n not in self.state["measured"] and not n.endswith("_NOT_BUILT") and re.search(pattern, n)]

        def measure_one(name):
            if self.is_late():
                return
            with tempfile.NamedTemporaryFile("r", suffix=".reached") as file:
                passed, seconds = self.tests.run(name, (), limit, file.name)
                reached = sorted({int(line) for line in file})
            if not passed and seconds < limit:
                print(f"{name} fails without a fault")
                return
            self.state["measured"][name] = {"seconds": round(seconds, 3), "reached": reached if passed else None}

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(measure_one, names))
        self.save()

    def open_faults(self, name):
        """Faults that the test may find and that nobody has found."""
        reached = self.state["measured"][name]["reached"]
        asked = self.state["asked"].get(name, ())
        return [n for n in (self.faults if reached is None else reached) if str(n) not in self.state["found"] and n not in asked]

    def find(self, name, faults, limit):
        """Faults of these that the test finds."""
        passed, _ = self.tests.run(name, faults, limit)
        if passed:
            return []
        if len(faults) == 1:
            return faults
        half = len(faults) // 2
        return self.find(name, faults[:half], limit) + self.find(name, faults[half:], limit)

    def hunt(self, pattern, slowest, jobs):
        measured = self.state["measured"]
        names = [n for n in measured if re.search(pattern, n) and n in self.tests.commands and measured[n]["seconds"] <= slowest]

        def hunt_one(name):
            faults = [] if self.is_late() else self.open_faults(name)
            if not faults:
                return
            seconds = measured[name]["seconds"]
            found = self.find(name, faults, 2 * seconds + 1)
            for number in found:
                self.state["found"].setdefault(str(number), name)
            self.state["asked"].setdefault(name, []).extend(faults)
            if found:
                print(f"{seconds:8.2f} s  {name}: {len(found)} of {len(faults)}, {len(self.faults) - len(self.state['found'])} are open", flush=True)
            self.save()

        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            list(pool.map(hunt_one, sorted(names, key=lambda n: measured[n]["seconds"])))

    def report(self):
        measured, found = self.state["measured"], self.state["found"]
        programs = {}
        for name, entry in measured.items():
            row = programs.setdefault(self.tests.program(name), [0, 0.0, 0, 0.0])
            row[0] += 1
            row[1] += entry["seconds"]
        for name in found.values():
            row = programs[self.tests.program(name)]
            row[2] += 1
            row[3] = max(row[3], measured[name]["seconds"])
        print("program | tests | seconds | faults found first | slowest test that found one first")
        for program, (count, seconds, first, slowest) in sorted(programs.items(), key=lambda item: -item[1][1]):
            print(f"{program} | {count} | {seconds:.1f} | {first} | {slowest:.2f}")
        reached = set().union(*(entry["reached"] or () for entry in measured.values()))
        print(f"{len(self.faults)} faults, {len(reached)} reached, {len(found)} found; not found:")
        for number, fault in self.faults.items():
            if str(number) not in found:
                how = "" if number in reached else ", not reached"
                print(f"{number} {fault['path']}:{fault['line']} {fault['operator']}: {fault['old']!r} to {fault['new']!r}{how}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("what", choices=("measure", "hunt", "report"))
    parser.add_argument("--programs", type=pathlib.Path, help="a build without faults, whose programs run with the library of BUILD; unit tests are of BUILD")
    parser.add_argument("--notes", type=pathlib.Path, help="a file in place of BUILD/hunt.json, where tests run otherwise")
    parser.add_argument("--tests", default=".", help="a pattern of names")
    parser.add_argument("--limit", type=float, default=600, help="measure: most seconds of processor for a test")
    parser.add_argument("--slowest", type=float, default=1e9, help="hunt: only tests that take at most so many seconds")
    parser.add_argument("--jobs", type=int, default=1, help="tests at a time")
    parser.add_argument("--minutes", type=float, default=1e9, help="end after so long")
    args = parser.parse_args()
    hunt = Hunt(args.build.resolve(), args.programs and args.programs.resolve(), args.notes, time.time() + 60 * args.minutes)
    if args.what == "measure":
        hunt.measure(args.tests, args.limit, args.jobs)
    elif args.what == "hunt":
        hunt.hunt(args.tests, args.slowest, args.jobs)
    else:
        hunt.report()


if __name__ == "__main__":
    main()
