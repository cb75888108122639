#!/usr/bin/env bash
# tests/long/fuzz.sh [MINUTES [TARGET...]]: runs the fuzz targets of tests/fuzz for so many minutes each (default 60),
# with clang's address and undefined-behaviour sanitizers, guided by coverage. Stop it at any time: the same command gives
# each target the rest of its minutes, with the inputs that are collected in build-fuzz/corpus. A change of the program
# begins the minutes anew. Prints a table, and a line of sums. Findings are in build-fuzz/found: mend each, and keep it in
# tests/fuzz/regressions/TARGET.
#   JOBS=N       targets at once (default: one)
#   FINDINGS=N   a target ends after so many new findings (default: 10)
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
source cmake/packages.sh
minutes=${1:-60}
shift $(($# ? 1 : 0))
if ! command -v clang++ > /dev/null ||
  ! compgen -G "/usr/lib/llvm-*/lib/clang/*/lib/linux/libclang_rt.fuzzer-$(uname -m).a" > /dev/null; then
  echo "there is no clang++ with libFuzzer; as root: apt-get install clang libclang-rt-dev"
  exit 77
fi
# The compiler's cache then serves other copies of the source, too (fuzz_faults.sh).
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
mkdir -p build-fuzz
{
  flock 9  # of two that run at once, one builds
  configure fuzz
  nice cmake --build build-fuzz --target test_fuzz -j "${JOBS:-1}" < /dev/null
} 9> build-fuzz/lock
program=$PWD/build-fuzz/test_fuzz
mapfile -t all < <("$program")
targets=("$@")
((${#targets[@]})) || targets=("${all[@]}")
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1  # foreign libraries leak
export UBSAN_OPTIONS=print_stacktrace=1
# For each target its seconds and executions until now.
spent=build-fuzz/spent/$(sha256sum < "$program" | cut -c1-12)
mkdir -p build-fuzz/log "$spent"

# executions LOG: at its end, or as far as it is.
executions() {
  local all
  all=$(sed -n 's/^stat::number_of_executed_units: *//p' "$1")
  [[ $all ]] || all=$(grep -aoE '^#[0-9]+' "$1" | tail -n 1 | tr -d '#')
  echo "${all:-0}"
}

# findings TARGET: how many there are.
findings() { find "build-fuzz/found/$1" -type f | wc -l; }

# run TARGET: its row of the table. Each finding ends libFuzzer, which then is started again.
run() {
  local target=$1 corpus=build-fuzz/corpus/$1 found=build-fuzz/found/$1 log=build-fuzz/log/$1 inputs
  local seconds=0 tried=0 status=0 first before begin fuzzer counters
  mkdir -p "$corpus" "$found"
  inputs=("$corpus" "$corpus.seeds")
  [[ ! -d tests/fuzz/regressions/$target ]] || inputs+=("tests/fuzz/regressions/$target")
  [[ ! -e $spent/$target ]] || read -r seconds tried < "$spent/$target"
  first=$(findings "$target")
  while ((seconds < 60 * minutes)); do
    before=$(findings "$target") begin=$SECONDS
    nice "$program" --target="$target" --seeds="$corpus.seeds" -dict="$corpus.seeds.words" -print_final_stats=1 \
      -max_total_time=$((60 * minutes - seconds)) -timeout=60 -report_slow_units=60 -rss_limit_mb=4096 \
      -malloc_limit_mb=2048 -artifact_prefix="$found/" "${inputs[@]}" &> "$log.now" &
    fuzzer=$!
    trap "kill $fuzzer" EXIT
    while kill -0 $fuzzer 2> /dev/null; do
      sleep 1
      echo "$((seconds + SECONDS - begin)) $((tried + $(executions "$log.now")))" > "$spent/$target.new"
      mv "$spent/$target.new" "$spent/$target"
    done
    status=0
    wait $fuzzer || status=$?
    trap - EXIT
    tried=$((tried + $(executions "$log.now"))) seconds=$((seconds + SECONDS - begin))
    ((status != 0)) || seconds=$((seconds < 60 * minutes ? 60 * minutes : seconds))
    echo "$seconds $tried" > "$spent/$target"
    cat "$log.now" >> "$log"
    # It fails by a new finding, or because it could not fuzz: it would fail again.
    ((status != 0 && $(findings "$target") > before && $(findings "$target") - first < ${FINDINGS:-10})) || break
  done
  counters=$(sed -n 's/.*cov: \([0-9]*\) ft: \([0-9]*\).*/\1 | \2/p' "$log" | tail -n 1)
  echo "| $target | $((seconds / 60)) | $tried | ${counters:-0 | 0} | $(findings "$target") |"
  if ((tried == 0 || status != 0 && $(findings "$target") == first)); then
    echo "$target: status $status, see $log" >&2
    return 1
  fi
}
export -f run executions findings
export program minutes spent
TMPDIR=$(mktemp -d /dev/shm/roam-fuzz-XXXXXX 2> /dev/null || mktemp -d)  # in memory, if it can be
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
table=$TMPDIR/table
echo '| target | minutes | executions | edges | features | findings |'
echo '|---|---|---|---|---|---|'
wrong=0
printf '%s\n' "${targets[@]}" | xargs -P "${JOBS:-1}" -I{} bash -c 'run {}' | tee "$table" || wrong=1
awk -F ' *[|] *' '{ ++n; m += $3; e += $4; f += $7 }
  END { printf "%d targets, %d minutes, %.0f executions, %d findings\n", n, m, e, f; exit f > 0 }' "$table" || wrong=1
exit $wrong
