#!/usr/bin/env bash
# tests/long/coverage.sh [FOLDER]
# Line and branch coverage of the core (math, sweep, index, world, motion) by the core's own tests, built in FOLDER
# (build-coverage). Prints a line a file, with the lines that no test runs. Needs gcovr. About half an hour.
set -euo pipefail
source_folder=$(realpath "$(dirname "$0")/../..")
folder=$(realpath -m "${1:-$source_folder/build-coverage}")
command -v gcovr > /dev/null || { echo "there is no gcovr; as root: apt-get install gcovr" >&2; exit 77; }
cmake -S "$source_folder" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Coverage -DCMAKE_CXX_FLAGS_COVERAGE='-O1 --coverage -fprofile-update=atomic' \
  -DROAM_TOOLS=OFF -DROAM_TEST_TIMEOUT=3600 -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > /dev/null
cmake --build "$folder"
find "$folder" -name '*.gcda' -delete
tests=$("$source_folder/tests/long/ctest.sh" "$folder" --quiet) || { echo "$tests"; exit 1; }
cd "$source_folder"
gcovr --root . --object-directory "$folder" --filter 'src/(math|sweep|index|world|motion)/' --exclude-throw-branches \
  --exclude-unreachable-branches --print-summary "$folder" > "$folder/coverage.txt"
cat "$folder/coverage.txt"
# "lines: 99.9% (1 out of 2)", and the same of branches.
figures=$(sed -n 's/^\(lines\|branches\): /\1 /p' "$folder/coverage.txt" | paste -sd,)
[[ $figures ]]
echo "the core: ${figures//,/, }; $(tail -n 1 <<< "$tests")"
