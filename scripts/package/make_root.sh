#!/bin/sh
# Part of make-release and install-packages: makes the Debian root $1, of suite $2, with the packages $3; the other words
# are options for mmdebstrap. A root that has them stays.
set -eu
root=$1 suite=$2 packages=$3
shift 3
if [ -e "$root" ] || [ -L "$root" ]; then
  [ "$(cat "$root.packages" 2> /dev/null)" != "$packages" ] || exit 0
  echo "${0##*/}: $root was made of other packages: remove it, and it will be made anew" >&2
  exit 1
fi
echo "making a Debian in $root (some 15 minutes; log: $root.log)"
new=$root.$$ job=
trap 'rm -rf --one-file-system -- "$new"' EXIT
trap '[ -z "$job" ] || kill "$job" 2> /dev/null || :; wait; exit 1' HUP INT TERM
timeout 0 mmdebstrap --variant=minbase --aptopt='APT::Install-Recommends "false"' --include="$packages" "$@" "$suite" "$new" \
  ${DEBIAN_MIRROR:+"$DEBIAN_MIRROR"} > "$root.log" 2>&1 & job=$!
wait $job || {
  tail -n 5 "$root.log" >&2
  echo "${0##*/}: $root could not be made; see $root.log. DEBIAN_MIRROR=ADDRESS names a mirror of an earlier date that has missing versions." >&2
  exit 1
}
echo "$packages" > "$root.packages"
mv -T "$new" "$root"
