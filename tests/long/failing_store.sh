#!/usr/bin/env bash
# tests/long/failing_store.sh SCENE STORE WAY [ROUNDS]
# Flies along WAY at 50 m/s, in 64 MiB, through a store that may be of any size: with reads that wait for two seconds
# each, with reads that fail, and through ROUNDS (3) copies of it of which a sixteenth of the packs is missing, and as
# many with a wrong bit in each pack. Each walk is checked against all triangles of SCENE. It may be slow, or be held,
# but goes through nothing and names what failed; unchecked it takes no more than 64 + 25 MiB. SCENE is read once a walk,
# so 100 m will do; takes as much disk as STORE. Needs strace.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
trap 'rm -rf "$work"' EXIT
if (($# < 3)); then
  sed -n 2p "$0" >&2
  exit 2
fi
scene=$1 store=$2 way=$3 rounds=${4:-3}
need_strace
RANDOM=1

number() { sed -n "s/^ *\"$1\": \"\{0,1\}\([^,\"]*\)\"\{0,1\},\{0,1\}$/\1/p" "$work/report" | head -1; }

# walked STORE WHAT MUST [COMMAND...]: flies, under a command where there is one, and judges. MUST is "moves",
# "reaches", "fails" if it must move and some reads must fail, or "any": it may be held at its start.
walked() {
  local command=(timeout 3600 "${@:4}" "$roam" walk "$1" --path "$way" --mode fly --speed 50 --memory 64M)
  # What checks the moves has the whole scene in memory.
  measured "${command[@]}" --json > "$work/report" 2> "$work/said"
  local unchecked=$?
  if ((unchecked != 0 && unchecked != 3)) || [[ $3 != any && $(number length_m) == 0 ]]; then
    complain "$2: unchecked, status $unchecked, it flies no way: $(tail -1 "$work/said")"
  fi
  "${command[@]}" --against "$scene" --json > "$work/report" 2> "$work/said"
  local status=$?
  if ((status != 0 && status != 3)); then
    complain "$2: status $status: $(tail -1 "$work/said")"
    return
  fi
  echo "$2: $(number outcome) after $(number length_m) m, $(number throttled) steps throttled, $(number failures)" \
    "failures, $(number violations) violations; $SECONDS s"
  [[ $(number violations) == 0 ]] || complain "$2: goes through something"
  [[ $(number overstated_clearances) == 0 ]] || complain "$2: overstates a clearance"
  [[ $3 == any || $(number pieces) != 0 ]] || complain "$2: no move was checked"
  (($(cat "$work/peak") <= 64 + 25)) || complain "$2: takes $(cat "$work/peak") MiB"
  [[ $3 != reaches || $status == 0 ]] || complain "$2: does not reach its end"
  [[ $3 != fails || $(number failures) != 0 ]] || complain "$2: no read has failed"
  if [[ $(number failed) != 0 ]]; then
    grep -qE '"last_failure": ".*(tile|page)' "$work/report" || complain "$2: what failed is not named"
  fi
}
# reads WHAT: strace that does it to the reads from the fortieth on.
reads() { echo "strace -f -qqq -o /dev/null -e trace=pread64 -e inject=pread64:$1"; }

walked "$store" undisturbed reaches
# shellcheck disable=SC2046  # a command in words
walked "$store" "reads that wait 2 s" moves $(reads delay_enter=2000000:when=40+)
# shellcheck disable=SC2046
walked "$store" "one read in three fails" fails $(reads error=EIO:when=40+3)
for ((round = 1; round <= rounds; ++round)); do
  rm -rf "$work/bad"
  cp -r "$store" "$work/bad"
  for pack in "$work"/bad/packs/*.pack; do ((RANDOM % 16)) || rm "$pack"; done
  walked "$work/bad" "packs missing, $round" any
  rm -rf "$work/bad"
  cp -r "$store" "$work/bad"
  for pack in "$work"/bad/packs/*.pack; do
    at=$((64 + (RANDOM * 32768 + RANDOM) % ($(stat -c %s "$pack") - 64)))
    byte=$(od -An -tu1 -j $at -N1 "$pack")
    printf "\\x$(printf %02x $((byte ^ (1 << RANDOM % 8))))" | dd of="$pack" bs=1 seek=$at conv=notrunc status=none
  done
  walked "$work/bad" "a bit of each pack wrong, $round" any
done
finish "$((3 + 2 * rounds)) walks"
