#!/usr/bin/env bash
# How many instructions roam's own code takes for fixed queries, under callgrind: a guard of speed that is no noise.
#   instruction_counts.sh check PROGRAM BASELINE TOOLS    compares with the baseline; status 77 where it cannot
#   instruction_counts.sh renew PROGRAM BASELINE TOOLS    writes what is counted into the baseline
# TOOLS names compiler and Highway with their versions: others make other code, and have a section of their own.
# CONTRIBUTING.md says when a baseline may be renewed.
set -euo pipefail
what=$1 program=$(realpath "$2") baseline=$3 tools=$4
band=3 # per cent
renew="cmake --build BUILD_FOLDER --target renew_instruction_counts"

if ! command -v valgrind > /dev/null; then
  echo "skipped: valgrind is not installed; cmake/packages.sh lists what to install"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" > "$work/rows"
if grep --quiet '^skipped' "$work/rows"; then
  cat "$work/rows"
  exit 77
fi
# Each function row_* is counted with all that it calls, and gives a file of its own.
dumps=()
while read -r row _; do dumps+=("--dump-after=row_$row"); done < "$work/rows"
valgrind --tool=callgrind --quiet --toggle-collect='row_*' "${dumps[@]}" --compress-strings=no --compress-pos=no \
  --callgrind-out-file="$work/out" "$program" > /dev/null || {
  # It has just run without valgrind.
  status=$?
  ((status == 132)) || exit "$status"
  echo "skipped: valgrind does not know an instruction that this machine's libraries choose (SIGILL)"
  exit 77
}

# Of a row: the instructions in roam's own objects. Those of the C library differ from machine to machine. A line after
# "calls=" is what was called, which has lines of its own.
number=0
while read -r row times; do
  number=$((number + 1))
  file=$work/out.$number
  grep --quiet "^desc: Trigger: .*row_$row\$" "$file" || { echo "callgrind has no counts of row_$row"; exit 1; }
  count=$(awk -v program="$program" '
    /^ob=/ { own = substr($0, 4) == program || /\/libroam[^\/]*$/ }
    /^calls=/ { getline; next }
    own && /^[0-9+*-]/ { sum += $2 }
    END { printf "%d", sum }' "$file")
  ((count > 0)) || { echo "nothing was counted in row_$row: callgrind names other objects than $program" >&2; exit 1; }
  echo "$row $count $times"
done < "$work/rows" > "$work/counts"

section() { awk -v key="[$tools]" '/^\[/ { inside = $0 == key; next } inside && NF' "$baseline"; }
if [[ $what == renew ]]; then
  # The other sections stay as they are.
  awk -v key="[$tools]" '/^\[/ { inside = $0 == key } !inside' "$baseline" | cat -s > "$work/new"
  { sed -e '$a\' "$work/new" | sed -e '${/^$/d}'; echo; echo "[$tools]"; cut -d' ' -f1,2 "$work/counts"; } > "$baseline"
  echo "$baseline has the counts of $tools:"
elif [[ -z $(section) ]]; then
  echo "skipped: $baseline has no counts of $tools; write them by: $renew"
  exit 77
fi

section > "$work/expected"
awk -v band=$band '
  FNR == NR { expected[$1] = $2; next }
  FNR == 1 { printf "%-20s %14s %14s %9s %12s\n", "row", "instructions", "baseline", "change", "each" }
  {
    seen[$1]
    change = expected[$1] ? 100 * ($2 / expected[$1] - 1) : 100
    out = change > band || change < -band
    bad += out
    printf "%-20s %14d %14d %8.2f%% %12.1f%s\n", $1, $2, expected[$1], change, $2 / $3, out ? "  <-- out of the band" : ""
  }
  END {
    for (row in expected) {
      if (!(row in seen)) { printf "%-20s is in the baseline and was not counted\n", row; ++bad }
    }
    exit bad > 0
  }' "$work/expected" "$work/counts" || {
  echo "More than $band % from the baseline. More: find out why, and mend it. Fewer, or more for a good reason:"
  echo "  $renew"
  exit 1
}
