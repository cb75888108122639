#!/usr/bin/env bash
# tests/long/certificates.sh [TRIANGLES]
# Flies 31.6 km, about 36,000 steps, along the paper's paths in a gallery of TRIANGLES (5M) with a certificate, which
# `roam check` must accept; both take at most 60 s of a processor.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
trap 'rm -rf "$work"' EXIT
number() { sed -n "s/^ *\"$1\": \"\{0,1\}\([^,\"]*\)\"\{0,1\},\{0,1\}$/\1/p" "$2" | head -1; }

"$roam" make gallery -o "$work/g.ply" --triangles "${1:-5M}" > /dev/null || exit 1
for ((i = 0; i < 7; ++i)); do
  printf '%s\n' '-13739 253 182' '-12504 1566 182' '-12228 1927 182' '-12504 1566 182'
done > "$work/fly.path"
echo '-13739 253 182' >> "$work/fly.path"

# timed COMMAND...: with its processor seconds in $seconds.
timed() {
  TIMEFORMAT='%U %S'
  { time "$@" 2> "$work/said"; } 2> "$work/time"
  local status=$?
  seconds=$(awk '{ print $1 + $2 }' "$work/time")
  return $status
}
timed "$roam" walk "$work/g.ply" --path "$work/fly.path" --mode fly --speed 50 --certify "$work/flown" --json > "$work/walk" ||
  complain "the flight: $(tail -1 "$work/said")"
flown=$seconds
timed "$roam" check "$work/flown" "$work/g.ply" --json > "$work/check" || complain "is refused: $(number why "$work/check")"
checked=$seconds
steps=$(number steps "$work/walk") segments=$(number segments "$work/check")
((${steps:-0} > 36000 && ${segments:-0} >= steps)) || complain "only ${steps:-0} steps and ${segments:-0} segments"
awk "BEGIN { exit !($flown + $checked <= 60) }" || complain "takes more than 60 s"
finish "$steps steps in $(number triangles "$work/check") triangles, certified in $flown s of a processor, with reading; \
$segments segments checked in $checked s; least gap $(printf %.3f "$(number least_gap_m "$work/check")") m"
