"""What the figures were measured on: words for the top of the page."""
import os
import platform
import re
import subprocess
from importlib import metadata
from pathlib import Path

PACKAGES = (("Bullet", "libbullet-dev"), ("Embree", "libembree-dev"), ("FCL", "libfcl-dev"), ("GMP", "libgmp-dev"),
            ("Eigen", "libeigen3-dev"), ("CGAL", "libcgal-dev"))


def first_line(*command):
    """First line that a command prints, or an empty string."""
    try:
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    except (OSError, subprocess.CalledProcessError):
        return ""
    return lines[0].strip() if lines else ""


def processor():
    info = Path("/proc/cpuinfo")
    text = info.read_text(encoding="utf-8") if info.exists() else ""
    model = re.search(r"^model name\s*: (.*)$", text, re.M)
    kinds = [kind for kind in ("avx2", "avx512f") if re.search(rf"^flags\s*:.*\b{kind}\b", text, re.M)]
    name = model.group(1).strip() if model else platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} threads{''.join(', ' + kind.upper() for kind in kinds)}"


def system():
    release = platform.freedesktop_os_release() if hasattr(platform, "freedesktop_os_release") else {}
    return f"{release.get('PRETTY_NAME', platform.system())}, kernel {platform.release()}"


def describe(root):
    """(name, value) in the order to be shown; `root` is the project's folder."""
    facts = [("Processor", processor()), ("System", system()), ("Compiler", first_line("c++", "--version"))]
    revision = first_line("git", "-C", str(root), "describe", "--always", "--dirty")
    version = re.search(r"^project\(\w+ VERSION (\S+)", (Path(root) / "CMakeLists.txt").read_text(encoding="utf-8"), re.M)
    facts.append(("Dartsweep", (version.group(1) if version else "") + (f", revision {revision}" if revision else "")))
    for name, package in PACKAGES:
        found = first_line("dpkg-query", "-W", "-f", "${Version}", package)
        if found:
            facts.append((name, found))
    for name, package in (("IPC Toolkit (Tight-Inclusion)", "ipctk"), ("MuJoCo", "mujoco")):
        try:
            facts.append((name, metadata.version(package)))
        except metadata.PackageNotFoundError:
            pass
    return [(name, value) for name, value in facts if value]
