#!/usr/bin/env bash
# Whether programs that were built with an earlier roam.h still run with this libroam.so.
#   abi.sh SOURCE LIBRARY CXX   compares the library's symbols with src/c/libroam.map, and the structs and constants of
#                               roam.h with tests/c/abi.txt
#
# A line of abi.txt never changes, except that a struct may grow when members are appended: ROAM_INTERFACE grows then.
set -euo pipefail
source=$1 library=$2 compiler=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sed -n 's/^    \(roam_[a-z0-9_]*\);$/\1/p' "$source/src/c/libroam.map" | sort > "$work/map"
nm -D --defined-only "$library" | sed -n 's/^[0-9a-f]* T //p' | sed 's/@.*//' | sort > "$work/symbols"
diff "$work/map" "$work/symbols" || { echo "the library has other symbols than src/c/libroam.map"; exit 1; }
others=$(nm -D --defined-only "$library" | grep -vE ' T roam_[a-z0-9_]+(@@ROAM_[0-9]+)?$| A ROAM_[0-9]+' || true)
[[ -z $others ]] || { echo "the library shows more than functions roam_*:"; echo "$others"; exit 1; }
grep -oE '\broam_[a-z0-9_]+\(' "$source/include/roam/roam.h" | tr -d '(' | sort -u > "$work/mentioned"
[[ -z $(comm -23 "$work/map" "$work/mentioned") ]] || { comm -23 "$work/map" "$work/mentioned"; exit 1; }

"$compiler" -x c -std=c99 -Wall -Wextra -Wpedantic -Werror -I "$source/include" "$source/tests/programs/abi.c" -o "$work/abi"
"$work/abi" > "$work/now"
diff "$source/tests/c/abi.txt" "$work/now" || { echo "the layout of roam.h is no longer that of tests/c/abi.txt"; exit 1; }
# Every struct and constant of the header is in the list.
for name in $(grep -oE '^typedef struct roam_[a-z_0-9]+ \{' "$source/include/roam/roam.h" | awk '{ print $3 }'); do
  grep -q "^$name " "$work/now" || { echo "tests/programs/abi.c does not print $name"; exit 1; }
done
for standard in c++11 c++20; do
  echo '#include <roam/roam.h>' | "$compiler" -x c++ "-std=$standard" -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
    -I "$source/include" -
done
echo "$(wc -l < "$work/map") functions and $(wc -l < "$work/now") numbers are as they were"
