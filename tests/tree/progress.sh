#!/usr/bin/env bash
# progress.sh SOURCE_FOLDER: what behind_line of cmake/packages.sh shows of a command: how far it is, and after a failure
# the end of the log and where it is. The log has everything.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source "$1/cmake/packages.sh"
log=$work/the.log

fail() { echo "$1: $(cat -v "$work/said")" && exit 1; }

# build LINES: ninja's output of so many steps, with a line of the compiler after each.
build() { for ((i = 1; i <= $1; ++i)); do printf '[%d/%d] Building %d.o\nnote %d\n' "$i" "$1" "$i" "$i"; done; }
broken() { build 30; echo "the mistake" >&2; return 7; }

echo "of before" > "$log"
behind_line "Building" "$log" build 20 > "$work/said" 2>&1 || fail "a success fails"
[[ $(cat "$work/said") == "$(echo "Building: 5 %"; printf 'Building: %d %%\n' {10..100..10})" ]] || fail "the tenths"
[[ $(wc -l < "$log") == 41 && $(head -n 1 "$log") == "of before" ]] || fail "the log lacks something"

status=0
behind_line "Building" "$log" broken > "$work/said" 2> "$work/wrong" || status=$?
cat "$work/wrong" >> "$work/said"
((status == 1)) || fail "a failure has status $status"
[[ $(head -n 1 "$work/wrong") == "Building: failed. The end of $log:" ]] || fail "does not say where the log is"
[[ $(sed 1d "$work/wrong") == "$(tail -n 40 "$log")" && $(tail -n 1 "$work/wrong") == "the mistake" ]] ||
  fail "does not show the end of the log"

# On a terminal there is one line, which changes.
export -f behind_line one_line build broken
on_terminal() {
  python3 -c 'import os, pty, sys; sys.exit(os.waitstatus_to_exitcode(pty.spawn(sys.argv[1:])))' bash -c "$1" < /dev/null
}
on_terminal "behind_line Building $log build 20" > "$work/said" || fail "a success on a terminal has status $?"
[[ $(wc -l < "$work/said") == 1 && $(cat "$work/said") == *"Building: 45 %"*"Building: done"* ]] || fail "on a terminal"
status=0
on_terminal "behind_line Building $log broken" > "$work/said" || status=$?
[[ $status == 1 && $(cat "$work/said") == *"Building: failed. The end of $log:"*"the mistake"* ]] ||
  fail "a failure on a terminal"
