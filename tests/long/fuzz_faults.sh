#!/usr/bin/env bash
# tests/long/fuzz_faults.sh [MINUTES]: plants a fault for each fuzz target, all in a copy of the source in build-fuzz,
# and runs each target until it finds its own, at most so many minutes (default 10). Prints a table; fails if a target
# finds nothing.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
root=$PWD copy=$PWD/build-fuzz/planted
rm -rf "$copy"
mkdir -p "$copy"
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents -t "$copy"
cd "$copy"
python3 tests/fuzz/faults.py --plant
status=0
FINDINGS=1 tests/long/fuzz.sh "${1:-10}" > "$root/build-fuzz/planted.table" || status=$?
cat "$root/build-fuzz/planted.table"
((status != 77)) || exit 77
# A row for each fault, each with findings.
planted=$(grep -c '^    ("' tests/fuzz/faults.py)
# grep fails if it finds none.
found=$(grep -c '^| [a-z]* |.*| [1-9][0-9]* |$' "$root/build-fuzz/planted.table" || true)
echo "$planted faults planted, $found found"
((found == planted))
