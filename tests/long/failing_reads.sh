#!/usr/bin/env bash
# tests/long/failing_reads.sh [COPIES]
# Walks a store whose packs are slow to read, cannot be read now and then, or never; and COPIES (100) copies of it with
# tiles damaged, missing or cut off. Every move is checked against all triangles of the scene: never a violation, never
# a crash, and unchecked no more memory than 8 + 25 MiB. What cannot be read holds the body, and is named; `roam verify` finds every
# damage. About ten minutes. Needs strace.
#
# Each bit of a small store, and 10^5 damages at random, are a program's:
#   ROAM_TEST_DAMAGES=100000 build-check/test_store --gtest_filter='StoreDamageBits*'
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
trap 'rm -rf "$work"' EXIT
copies=${1:-100}
need_strace

"$roam" make gallery -o "$work/a.ply" --triangles 300k > /dev/null || exit 1
scene=("$work/a.ply")
build "$work/whole" > "$work/said" 2>&1 || { cat "$work/said"; exit 1; }
# 300 m of the first path of the paper, and where it meets the second.
printf '%s\n' '-13739 253 182' '-13533.5 471.5 182' > "$work/way.path"
RANDOM=1
reached=0 stopped=0 failures=0

# walked STATUS WHAT [moves|reaches|fails]: what the walk that wrote $work/report found. It must move; also reach its end,
# or some of its reads must fail.
walked() {
  local status=$1 what=$2 must=${3:-} report=$work/report
  if ((status != 0 && status != 3)); then
    complain "$what: status $status: $(tail -1 "$work/said")"
    return
  fi
  if ((unchecked != 0 && unchecked != 3)) || { [[ $must ]] && ! grep -qE '"length_m": [0-9.]*[1-9]' "$work/unchecked"; }; then
    complain "$what: unchecked, status $unchecked, it walks no way: $(tail -1 "$work/unchecked")"
  fi
  if ((status == 0)); then reached=$((reached + 1)); else stopped=$((stopped + 1)); fi
  grep -q '"violations": 0,' "$report" || complain "$what: goes through something: $(grep '"violations"' "$report")"
  grep -q '"overstated_clearances": 0,' "$report" || complain "$what: overstates a clearance"
  [[ ! $must ]] || grep -q '"pieces": [1-9]' "$report" || complain "$what: no move was checked"
  (($(cat "$work/peak") <= 8 + 25)) || complain "$what: takes $(cat "$work/peak") MiB"
  [[ $must != reaches ]] || ((status == 0)) || complain "$what: does not reach its end"
  if ! grep -q '"failures": 0,' "$report"; then
    failures=$((failures + 1))
  elif [[ $must == fails ]]; then
    complain "$what: no read has failed"
  fi
  # Held by what failed: then the failure is named.
  if grep -q '"failed": [1-9]' "$report"; then
    grep -qE '"last_failure": ".*(tile|page)' "$report" || complain "$what: what failed is not named"
  fi
}
# walk STORE OPTIONS...: twice, for what checks the moves has the whole scene in memory.
walk() {
  local command=(timeout 300 "${before[@]}" "$roam" walk "$1" --path "$work/way.path" --speed 20 "${@:2}" --memory 8M)
  measured "${command[@]}" --json > "$work/unchecked" 2> "$work/said"
  unchecked=$?
  "${command[@]}" --against "${scene[@]}" --json > "$work/report" 2> "$work/said"
}

for mode in fly walk; do
  options=(--mode $mode --height 1.8)
  before=()
  walk "$work/whole" "${options[@]}"
  walked $? "$mode, undisturbed" reaches
  # Not the first reads: a body that is held at its start goes through nothing.
  for inject in error=EIO:when=20+2 error=EIO:when=5+7 error=EIO:when=20+ error=ESTALE:when=10+3 error=EINTR:when=3+2 \
    retval=0:when=4+3 delay_enter=20000 delay_enter=200000:when=5+5 delay_enter=2000000:when=20+20; do
    before=(strace -f -qqq -o /dev/null -e trace=pread64 -e "inject=pread64:$inject")
    walk "$work/whole" "${options[@]}"
    # A read that is interrupted is tried again.
    walked $? "$mode, pread64 $inject" "$([[ $inject == delay_* || $inject == error=EINTR* ]] && echo moves || echo fails)"
  done
  for inject in error=EMFILE:when=60+2 error=EACCES:when=60+; do
    before=(strace -f -qqq -o /dev/null -e trace=openat -e "inject=openat:$inject")
    walk "$work/whole" "${options[@]}"
    status=$?
    if ((status != 1)); then
      walked $status "$mode, openat $inject"
      continue
    fi
    # The reader of the scene, which judges, opens files too: it may refuse. The walk itself goes on.
    grep -q . "$work/said" || complain "$mode, openat $inject: refused without a word"
    ((unchecked == 0 || unchecked == 3)) || complain "$mode, openat $inject: unchecked, status $unchecked"
  done
  echo "$mode: $reached reached, $stopped stopped, $failures with failures; $wrong wrong; $SECONDS s"
done

before=()
pack=$(cd "$work/whole" && ls packs/*.pack)
size=$(stat -c %s "$work/whole/$pack")
damaged=0 found=0
random() { echo $((RANDOM * 32768 + RANDOM)); }
for ((i = 0; i < copies; ++i)); do
  rm -rf "$work/bad"
  cp -r "$work/whole" "$work/bad"
  case $((i % 5)) in
    0 | 1) # bytes here and there
      what="$((1 + i)) bytes"
      for ((k = 0; k <= i; ++k)); do
        printf "\\x$(printf %02x $((RANDOM % 256)))" |
          dd of="$work/bad/$pack" bs=1 seek=$((64 + $(random) % (size - 64))) conv=notrunc status=none
      done
      ;;
    2) # blocks of zeros, as a disk leaves them that lost its power
      what="blocks of zeros"
      for ((k = 0; k <= i / 10; ++k)); do
        dd if=/dev/zero of="$work/bad/$pack" bs=4096 count=1 seek=$(($(random) % (size / 4096))) conv=notrunc status=none
      done
      ;;
    3)
      what="the end cut off"
      truncate -s $(($(random) % size)) "$work/bad/$pack"
      ;;
    4) # the index at the end stays; half of the tiles go
      what="noise over half of the tiles"
      dd if=/dev/urandom of="$work/bad/$pack" bs=4096 count=$((size / 8192)) seek=$(($(random) % (size / 8192))) \
        conv=notrunc status=none
      truncate -s "$size" "$work/bad/$pack"
      ;;
  esac
  cmp -s "$work/whole/$pack" "$work/bad/$pack" && continue  # zeros over zeros
  damaged=$((damaged + 1))
  "$roam" verify "$work/bad" > "$work/said" 2>&1
  status=$?
  ((status == 3)) && found=$((found + 1)) || complain "$what: verify says $status: $(tail -1 "$work/said")"
  walk "$work/bad" --mode fly
  walked $? "$what"
done
echo "damaged copies: verify found $found of $damaged"

# A pack that is not there at all.
rm -rf "$work/bad"
cp -r "$work/whole" "$work/bad"
rm "$work/bad/$pack"
"$roam" verify "$work/bad" > "$work/said" 2>&1
(($? == 3)) || complain "no pack: verify does not see it: $(tail -1 "$work/said")"
walk "$work/bad" --mode fly
walked $? "no pack"

finish "$reached walks reached their end, $stopped were stopped, $failures with reads that failed"
