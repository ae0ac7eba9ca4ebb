#!/bin/sh
# Runs trace on a text in NDC as if it were one in view space, before a parallel projection that changes nothing but the sign of z.
# usage: trace_from_ndc.sh TRACE CONFIG [OPTION...] < TEXT
set -eu
trace=$1 config=$2
shift 2
# Only the sign's character changes, so that the digits stay. Vertex lines begin with a number. A file, because from a pipe the
# message of an earlier stage is not repeated.
LC_ALL=C awk '
  { sub(/\r$/, "") }
  $1 ~ /^[-+.0-9]/ { if ($3 ~ /^-/) $3 = substr($3, 2); else { sub(/^\+/, "", $3); $3 = "-" $3 } }
  { print }' > view_space.txt
exec "$trace" --ortho -1 1 -1 1 -1 1 "$@" "$config" < view_space.txt
