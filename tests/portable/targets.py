#!/usr/bin/env python3
"""Proves that dartsweep_portable computes the same bits on several targets.

Each runner, which is a program with what starts it (an emulator, or nothing) and a kernel, computes the checksums
of hashes.txt and makes the recordings. Every runner replays the recordings of every other one. Files that are
byte-equal to files that the runner has replayed already are not replayed again: the last lines tell how many
replays were run and how many follow from equal bytes.

    targets.py --work FOLDER --runner NAME KERNEL PREFIX PROGRAM [--runner ...]

KERNEL is portable, avx2 or avx512, or "-" for targets that have one only. PREFIX is split as a shell does, and may be
empty. The first runner is the one that others are compared with.
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 3600  # for one command; emulators are slow
NO_SUCH_KERNEL = 77  # exit code of dartsweep_portable


class Runner:
    def __init__(self, name, kernel, prefix, program, work):
        self.name = name
        self.command = shlex.split(prefix) + [str(pathlib.Path(program).resolve())]
        self.environment = dict(os.environ)
        self.environment.pop("DARTSWEEP_KERNEL", None)
        if kernel != "-":
            self.environment["DARTSWEEP_KERNEL"] = kernel
        self.work = work
        self.files = {}  # name of a recording: checksum

    def run(self, *arguments):
        """Relative paths mean the same to all programs. Returns whether it went well, and its lines."""
        try:
            done = subprocess.run(self.command + list(arguments), cwd=self.work, env=self.environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            return False, [str(error)]
        return done.returncode == 0, done.stdout.splitlines()

    def is_here(self):
        """Whether the processor has the kernel. The program answers before it looks at its arguments."""
        code = subprocess.run(self.command + ["same"], env=self.environment, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, timeout=SECONDS, check=False).returncode
        if code == NO_SUCH_KERNEL:
            print(f"{self.name}: left out, this processor lacks the kernel")
        return code != NO_SUCH_KERNEL

    def hash(self):
        good, lines = self.run("hash", "--check", "hashes.txt")
        tell(self, "hash", good, [line for line in lines if line.startswith("differs")], lines)
        return good

    def record(self):
        folder = self.work / self.name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        good, lines = self.run("record", self.name)
        tell(self, "record", good, [], lines)
        if good:
            for name in (folder / "list.txt").read_text().split():
                self.files[name] = hashlib.sha256((folder / name).read_bytes()).hexdigest()
        return good

    def replay(self, folder):
        """Returns how many recordings did the same, of how many, and their calls."""
        good, lines = self.run("replay", folder)
        tell(self, f"replay of {folder}", good, [line for line in lines if ": " in line], lines)
        for line in lines:
            found = re.match(r"replays (\d+) of (\d+) identical, (\d+) calls", line)
            if found:
                return tuple(int(number) for number in found.groups())
        return 0, 0, 0


def tell(runner, what, good, differences, lines):
    print(f"{runner.name}: {what}: {'good' if good else 'WRONG'}; {lines[-1] if lines else 'no output'}")
    for line in differences[:8]:
        print(f"    {line}")
    sys.stdout.flush()


def put_apart(work, recorder, names):
    """A folder with some of the recordings of a runner."""
    folder = work / f"{recorder.name}_apart"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for name in names:
        shutil.copy(work / recorder.name / name, folder)
    (folder / "list.txt").write_text("".join(name + "\n" for name in names))
    return folder.name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", required=True, type=pathlib.Path)
    parser.add_argument("--runner", required=True, nargs=4, action="append",
                        metavar=("NAME", "KERNEL", "PREFIX", "PROGRAM"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    work = arguments.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "hashes.txt", work)
    runners = [Runner(*each, work) for each in arguments.runner]
    if len({runner.name for runner in runners}) != len(runners):
        parser.error("two runners have one name")
    runners = [runner for runner in runners if runner.is_here()]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        hashes = list(pool.map(Runner.hash, runners))
        recorded = list(pool.map(Runner.record, runners))

        base = runners[0]
        whole = len(base.files)
        # What others made otherwise than the first runner, or not at all.
        different = {}
        for runner in runners[1:]:
            names = [name for name, checksum in runner.files.items() if base.files.get(name) != checksum]
            missing = whole - len(set(runner.files) & set(base.files))
            if names or missing:
                print(f"{runner.name}: {len(names)} recordings differ from those of {base.name}, {missing} are missing")
            if names:
                different[runner] = (put_apart(work, runner, names), len(names))
        tasks = [(runner, base.name) for runner in runners if base.files]
        tasks += [(runner, folder) for recorder, (folder, _) in different.items() for runner in runners
                  if runner is not recorder]
        results = dict(zip(tasks, pool.map(lambda task: task[0].replay(task[1]), tasks)))

    calls = max((results[task][2] for task in tasks if task[1] == base.name), default=0)
    wanted = identical = follows = 0
    for recorder in runners:
        folder, apart = different.get(recorder, (None, 0))
        equal = sum(1 for name, checksum in recorder.files.items() if base.files.get(name) == checksum)
        for runner in runners:
            if runner is recorder:
                continue
            wanted += whole  # also what was not recorded
            if equal and (runner, base.name) in results:
                same, of, _ = results[runner, base.name]
                # Without a name of what failed no equal file counts.
                identical += equal if same == of else 0
                follows += equal if recorder is not base else 0
            if apart:
                identical += results[runner, folder][0]
    run = sum(result[1] for result in results.values())
    print(f"{run} replays were run, {sum(result[2] for result in results.values())} calls; {follows} of the pairs below "
          f"have byte-equal files, which the runner replayed once, as those of {base.name}")
    print(f"portable.hash_targets {sum(hashes)} of {len(hashes)}")
    print(f"portable.recorders {sum(recorded)} of {len(recorded)}")
    print(f"portable.replays_identical {identical} of {wanted}")
    print(f"portable.calls {calls}")
    return 0 if all(hashes) and all(recorded) and wanted == identical and not different and whole else 1


if __name__ == "__main__":
    sys.exit(main())
