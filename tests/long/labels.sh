#!/usr/bin/env bash
# tests/long/labels.sh [COUNT]: makes COUNT (1M) labelled sweeps, and judges roam's own answers to them, and two engines
# that are wrong: one that hits nothing must miss every hit, one that hits at once must be early. Ten minutes on two busy
# cores.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
trap 'rm -rf "$work"' EXIT
"$roam" bench labels --help &> /dev/null || { echo "this build has no benchmarks: -DROAM_BENCH=ON"; exit 77; }

# sum NAME: over all kinds, of $work/scores.
sum() { sed -n "s/^ *\"$1\": \([0-9]*\),*$/\1/p" "$work/scores" | awk '{ n += $1 } END { print n + 0 }'; }
# most NAME: the same, the greatest.
most() { sed -n "s/^ *\"$1\": \([-+.e0-9]*\),*$/\1/p" "$work/scores" | sort -g | tail -n 1; }
# judged TIME: an engine that always answers TIME.
judged() {
  yes "$1" | head -n "$sweeps" > "$work/times"
  "$roam" bench labels "$work/sweeps.npy" --judge "$work/times" --json > "$work/scores" 2> "$work/said" ||
    complain "judging times of $1: $(tail -n 1 "$work/said")"
}

"$roam" bench labels "$work/sweeps.npy" --count "${1:-1M}" --json > "$work/scores" 2> "$work/said" ||
  complain "roam's own answers: $(tail -n 1 "$work/said")"
cat "$work/scores"
sweeps=$(sum sweeps) hits=$(sum hits) missed=$(sum missed) late=$(sum late)
own="$sweeps sweeps, $hits hits: $missed missed, $late late, $(sum early) early, by at most $(printf %.2g "$(most farthest)") m"
((sweeps > 0 && missed == 0 && late == 0)) || complain "$own"

judged 1
# Not all: a hit may be shallower than what is tolerated.
((2 * $(sum missed) > hits)) || complain "an engine that hits nothing misses only $(sum missed)"
judged 0
((2 * $(sum early) > hits)) || complain "an engine that hits at once is early only $(sum early) times"
finish "$own"
