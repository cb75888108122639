#!/usr/bin/env bash
# tests/long/fuzz.sh [MINUTES [TARGET...]]: runs the fuzz targets of tests/fuzz for so many minutes each (default 60),
# with clang's address and undefined-behaviour sanitizers, guided by coverage. Stop it at any time; it goes on with the
# inputs that it has collected in build-fuzz/corpus. Prints a table at the end. Findings are in build-fuzz/found: mend
# each, and keep it in tests/fuzz/regressions/TARGET.
#   JOBS=N   targets at once (default: one)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
source cmake/packages.sh
minutes=${1:-60}
shift $(($# ? 1 : 0))
# The compiler's cache then serves other copies of the source, too (fuzz_faults.sh).
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
configure fuzz
nice cmake --build build-fuzz --target test_fuzz -j "${JOBS:-1}" < /dev/null
program=$PWD/build-fuzz/test_fuzz
mapfile -t all < <("$program")
targets=("$@")
((${#targets[@]})) || targets=("${all[@]}")
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1  # foreign libraries leak
export UBSAN_OPTIONS=print_stacktrace=1

# run TARGET: one line of the table.
run() {
  local target=$1 corpus=build-fuzz/corpus/$1 found=build-fuzz/found/$1 log=build-fuzz/log/$1 inputs
  mkdir -p "$corpus" "$found" build-fuzz/log
  inputs=("$corpus" "$corpus.seeds")
  [[ ! -d tests/fuzz/regressions/$target ]] || inputs+=("tests/fuzz/regressions/$target")
  nice "$program" --target="$target" --seeds="$corpus.seeds" -dict="$corpus.seeds.words" -print_final_stats=1 \
    -max_total_time=$((60 * minutes)) -timeout=60 -report_slow_units=60 -rss_limit_mb=4096 -malloc_limit_mb=2048 \
    -artifact_prefix="$found/" "${inputs[@]}" &> "$log"
  local status=$? executions counters
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  counters=$(sed -n 's/.*cov: \([0-9]*\) ft: \([0-9]*\).*/\1 | \2/p' "$log" | tail -n 1)
  echo "| $target | ${executions:-0} | ${counters:-0 | 0} | $(find "$found" -type f | wc -l) |"
  # libFuzzer fails by a finding, which is in its folder, or because it could not fuzz.
  if ((${executions:-0} == 0 || status != 0)) && [[ -z $(find "$found" -type f) ]]; then
    echo "$target: status $status, see $log" >&2
    return 1
  fi
}
export -f run
export program minutes
echo '| target | executions | edges | features | findings |'
echo '|---|---|---|---|---|'
printf '%s\n' "${targets[@]}" | xargs -P "${JOBS:-1}" -I{} bash -c 'run {}' || exit 1
[[ -z $(find build-fuzz/found -type f) ]]
