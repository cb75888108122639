#!/usr/bin/env bash
# check.sh PROGRAM TARGET FOLDER: runs one fuzz target over its seeds and regressions, and mutates them for a second.
# A finding is in FOLDER/found; tests/long/fuzz.sh looks for hours.
set -euo pipefail
program=$1 target=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder/corpus" "$folder/found"
inputs=("$folder/corpus" "$folder/seeds")
regressions=$(dirname "$0")/regressions/$target
[[ ! -d $regressions ]] || inputs+=("$regressions")
# As in tests/long/fuzz.sh, if this is a build with a sanitizer: foreign libraries leak.
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 TSAN_OPTIONS=allocator_may_return_null=1
TMPDIR=$(mktemp -d /dev/shm/roam-fuzz-XXXXXX 2> /dev/null || mktemp -d)  # in memory, if it can be
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
# Without coverage libFuzzer would throw all seeds away.
"$program" --target="$target" --seeds="$folder/seeds" -dict="$folder/seeds.words" -keep_seed=1 -seed=1 \
  -max_total_time="${ROAM_FUZZ_SECONDS:-1}" -timeout=60 -rss_limit_mb=0 -artifact_prefix="$folder/found/" \
  "${inputs[@]}"
