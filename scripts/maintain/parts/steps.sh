# Read by try-package and try-release: a log, a temporary folder, and steps.
# shellcheck shell=sh
self=$(readlink -f -- "$0")
name=${self##*/}
CDPATH='' cd -- "${self%/*}/../.." || exit
mkdir -p build
log=$PWD/build/$name.log
: > "$log"
work=$(mktemp -d)
trap 'rm -rf --one-file-system -- "$work"' EXIT
trap 'kill ${!-} 2> /dev/null || :; wait; exit 1' HUP INT TERM

# Ends because this machine lacks what the steps need: $1 says what.
skip() {
  echo "$name: skipped: $1"
  exit 77
}

# Runs a command with its output in the log, until a signal ends both.
logged() {
  "$@" >> "$log" 2>&1 &
  wait $!
}

# Runs a step quietly: $1 describes it, the other words are the command.
step() {
  what=$1
  shift
  echo "== $what" >> "$log"
  logged "$@" || {
    echo "FAIL  $what"
    tail -n 15 "$log" >&2
    exit 1
  }
  echo "ok    $what"
}

# Makes the folder $work/$1, a minimal Debian of suite $2; the other words are options for mmdebstrap.
make_root() {
  folder=$work/$1 suite=$2
  shift 2
  logged timeout 0 mmdebstrap --variant=minbase "$@" "$suite" "$folder" || {  # timeout passes signals on to all of it
    tail -n 1 "$log" >&2
    skip "a root of $suite could not be made: is there a network?"
  }
}
