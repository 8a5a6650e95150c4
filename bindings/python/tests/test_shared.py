"""The shared library that DARTSWEEP_LIBRARY names is the one that is loaded; the tests of abi/ guard it. A module that has the library in it
refuses the variable."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import dartsweep as ds
from dartsweep._library import SHARED

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = Path(ds.__file__).resolve().parent
ASK = "import dartsweep, re; print(*re.findall(r'\\S*libdartsweep\\.so\\S*', open('/proc/self/maps').read()), sep='\\n')"


def run(library: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "DARTSWEEP_LIBRARY": library, "PYTHONPATH": str(PACKAGE.parent)}
    return subprocess.run([sys.executable, "-c", ASK], env=environment, capture_output=True, text=True, check=False)


@pytest.mark.skipif(SHARED, reason="this module loads a shared library")
def test_a_module_with_the_library_in_it_says_so() -> None:
    made = run("/nowhere/libdartsweep.so")
    assert made.returncode != 0 and "DSW_PYTHON_SHARED" in made.stderr


@pytest.mark.skipif(not SHARED, reason="this module has the library in it")
class TestShared:
    def test_the_named_library_is_loaded(self) -> None:
        named = os.environ["DARTSWEEP_LIBRARY"]
        assert set(run(named).stdout.split()) == {str(Path(named).resolve())}

    def test_without_the_variable_it_is_found_by_itself(self) -> None:
        found = set(run("").stdout.split())
        assert len(found) == 1 and found.pop().endswith(".so.2.0.0")

    def test_a_copy_elsewhere_is_loaded(self, tmp_path: Path) -> None:
        copy = tmp_path / "libdartsweep.so.2"
        shutil.copy(Path(os.environ["DARTSWEEP_LIBRARY"]).resolve(), copy)
        assert set(run(str(copy)).stdout.split()) == {str(copy)}

    def test_what_is_no_library_is_refused(self) -> None:
        made = run(__file__)
        assert made.returncode != 0 and "DARTSWEEP_LIBRARY" in made.stderr

    @pytest.mark.skipif(shutil.which("cc") is None, reason="no compiler")
    def test_an_old_library_is_refused_when_it_is_loaded(self, tmp_path: Path) -> None:
        source, old = tmp_path / "old.c", tmp_path / "libdartsweep.so.2"
        source.write_text("unsigned dsw_version(void) { return 1000000; }\n", encoding="utf-8")
        (tmp_path / "old.map").write_text("DARTSWEEP_2 { global: dsw_version; local: *; };\n", encoding="utf-8")
        command = ["cc", "-shared", "-fPIC", "-Wl,-soname,libdartsweep.so.2", f"-Wl,--version-script={tmp_path / 'old.map'}"]
        subprocess.run([*command, "-o", str(old), str(source)], check=True)
        made = run(str(old))
        assert made.returncode != 0 and "DARTSWEEP_2.1" in made.stderr and str(old) in made.stderr

    @pytest.mark.skipif(shutil.which("nm") is None, reason="no nm")
    def test_the_module_asks_only_for_what_the_stable_interface_has(self) -> None:
        asked = subprocess.run(["nm", "-D", "--undefined-only", str(PACKAGE / "_native.abi3.so")], capture_output=True, text=True, check=True).stdout
        names = set(re.findall(r" U (dsw_\w+)", asked))
        headers = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "include/dartsweep").glob("*.h"))
        exported = set(re.findall(r"DSW_API[^;(]*?(dsw_\w+)\(", headers))
        assert len(names) > 100 and names <= exported
