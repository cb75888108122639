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
if tests/long/fuzz.sh "${1:-10}" > "$root/build-fuzz/planted.table"; then
  echo "no target finds its fault" >&2
  exit 1
fi
cat "$root/build-fuzz/planted.table"
# A line for each fault, each with findings.
(($(grep -c '| [1-9][0-9]* |$' "$root/build-fuzz/planted.table") == $(grep -c '^    ("' tests/fuzz/faults.py)))
