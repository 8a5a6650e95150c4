#!/usr/bin/env bash
# The tests of the report's page, with the modules that it needs: installs python3-venv if it is missing (Debian 12, as root).
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
if ! python3 -c 'import ensurepip, venv' 2> /dev/null; then
  [ "$(id -u)" -eq 0 ] || { echo "report: please install python3-venv" >&2; exit 1; }
  export DEBIAN_FRONTEND=noninteractive
  apt-get update -qq > /dev/null
  apt-get install -qq --no-install-recommends python3-venv > /dev/null
fi
"$here/../venv.sh"
"$here/../../../build/venv-report/bin/python" -m unittest discover -s "$here"
