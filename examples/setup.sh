# What the commands of this folder share; sourced by them. `name`, of the command, and `log`, a file that it has emptied, are theirs.

# fail CODE MESSAGE
fail() {
  echo "$name: $2" >&2
  exit "$1"
}

# quietly WHAT COMMAND...: with its output in the log; on failure shows the end of it.
quietly() {
  local what=$1
  shift
  "$@" >> "$log" 2>&1 < /dev/null || {
    tail -n 20 "$log" >&2
    fail 1 "$what failed; all of its output is in $log"
  }
}

# Packages: each line is a test that it is there, and what to install if it is not.
missing=()
needs_header() {
  local folder
  for folder in /usr/include /usr/local/include /usr/include/*-linux-gnu; do
    [ ! -e "$folder/$1" ] || return 0
  done
  missing+=("$2")
}
needs_build_tools() {
  command -v c++ > /dev/null && command -v cc > /dev/null || missing+=(g++)
  command -v cmake > /dev/null || missing+=(cmake)
  command -v make > /dev/null || missing+=(make)
  needs_header eigen3/Eigen/Core libeigen3-dev
}
# needs_venv [PYTHON]
needs_venv() {
  "${1:-python3}" -c 'import ensurepip, venv' 2> /dev/null || missing+=(python3-venv)
}
install_missing() {
  [ ${#missing[@]} -gt 0 ] || return 0
  command -v apt-get > /dev/null && [ "$(id -u)" -eq 0 ] ||
    fail 1 "these packages are missing and only root on Debian can have them installed here: ${missing[*]}"
  echo "installing ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  quietly "updating the package lists" apt-get update -q
  quietly "installing ${missing[*]}" apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# pip_of PYTHON: the file of the pip that its `ensurepip` holds. To run it from there is quicker than to install it.
pip_of() {
  "$1" -c 'import ensurepip, glob, os, sysconfig
folder = sysconfig.get_config_var("WHEEL_PKG_DIR") or os.path.join(os.path.dirname(ensurepip.__file__), "_bundled")
print(glob.glob(os.path.join(folder, "pip-*.whl"))[0] + "/pip")'
}
# make_venv FOLDER PYTHON LIST...: Python modules, pinned, in a folder of their own; again only when the lists have changed.
# Modules are compiled when they are first used. Whatever the environment asks, Python stores them compiled from here on, in all of a script.
make_venv() {
  local venv=$1 python=$2
  unset PYTHONDONTWRITEBYTECODE
  shift 2
  ! cat "$@" | cmp -s - "$venv/installed.txt" || return 0
  echo "installing $(cat "$@" | grep -v '^#' | tr '\n' ' ')in ${venv#"$root/"}"
  quietly "creating ${venv#"$root/"}" "$python" -m venv --clear --without-pip "$venv"
  quietly "installing Python modules" "$venv/bin/python" "$(pip_of "$python")" install --no-compile --disable-pip-version-check "${@/#/-r}"
  cat "$@" > "$venv/installed.txt"
}
