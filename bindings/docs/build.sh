#!/usr/bin/env bash
# The documentation as pages that open without a network: build/docs/html/index.html. A warning is an error.
# usage: bindings/docs/build.sh PYTHON    a Python with requirements.txt and the package dartsweep with its extras
set -euo pipefail
python=$1
cd "$(dirname "$0")/../.."
out=$PWD/build/docs
rm -rf "$out"
mkdir -p "$out/site"

(cat bindings/docs/Doxyfile; echo "OUTPUT_DIRECTORY = $out/site"; echo "XML_OUTPUT = $out/xml") | doxygen -
python3 bindings/docs/check_reference.py "$out/xml"
for example in examples/c/*.c; do
  grep -q "$example" bindings/docs/c_examples.md || { echo "c_examples.md is without $example"; exit 1; }
done
for example in examples/cpp/*.cpp; do
  grep -q "$example" bindings/docs/cpp.md || { echo "cpp.md is without $example"; exit 1; }
done

# Links between files of the project work as they stand, so its root is where Sphinx looks for pages.
echo '<!doctype html><meta http-equiv="refresh" content="0; url=bindings/docs/index.html">' > "$out/site/index.html"
"$python" -m sphinx -b html -c bindings/docs -W --keep-going -n -q -d "$out/doctrees" -D html_extra_path="$out/site" . "$out/html"
echo "docs: $(find "$out/html" -name '*.html' -not -path '*/c/*' | wc -l) pages and the C reference without a warning"
