# Sourced with the arguments of a script that lets valgrind count PROGRAM [--json FILE]: sets `program`, and `json` to FILE or
# else to what `json` is. The comment at the start of the script is its help.
case ${1:-} in
  '' | -h | --help)
    sed -n '2,/^set /{/^#/s/^# \{0,1\}//p;}' "$0"
    [ -n "${1:-}" ] || exit 2
    exit 0
    ;;
esac
program=$1
if [ $# -gt 1 ]; then
  [ "$2" = --json ] && [ $# = 3 ] || { echo "$(basename "$0" .sh): only --json FILE may follow" >&2; exit 2; }
  json=$3
fi
