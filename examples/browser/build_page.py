#!/usr/bin/env python3
"""Makes the page: build_page.py OUTPUT.html [--build FOLDER] [--with-tests]

FOLDER, by default build/browser, holds dartsweep.js and dartsweep.wasm, which build.sh has made; libraries are installed there, too.
OUTPUT.html needs no other file and no network. --with-tests installs what the tests of the page need. Exit code 1, with a message,
if the page can't be made.
"""
import argparse
import base64
import gzip
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "insertion"))
import bundle  # noqa: E402


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


def main():
    parser = argparse.ArgumentParser(description="Makes one HTML file in which the library runs.")
    parser.add_argument("output", help="the page")
    parser.add_argument("--build", default=os.path.join(HERE, "..", "..", "build", "browser"), metavar="FOLDER",
                        help="where the module is and libraries are installed (build/browser)")
    parser.add_argument("--with-tests", action="store_true", help="install what the tests of the page need, too")
    given = parser.parse_args()
    try:
        binary = gzip.compress(read(given.build, "dartsweep.wasm"), 9, mtime=0)
        data = {"module": base64.b64encode(binary).decode(),
                "worker": "\n".join(text.decode() for text in (read(given.build, "dartsweep.js"), read(HERE, "src", "worker.js")))}
        page = bundle.build(HERE, os.path.realpath(given.build), "Dartsweep in a browser", data, given.with_tests, with_module=True)
        with open(given.output, "w", encoding="utf-8", newline="\n") as file:
            file.write(page)
    except (OSError, bundle.BundleError) as error:
        bundle.fail(str(error))
    print(f"wrote {given.output}, {os.path.getsize(given.output) / 1e6:.1f} MB, of it the module {len(binary) / 1e6:.2f} MB compressed")


if __name__ == "__main__":
    main()
