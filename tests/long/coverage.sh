#!/usr/bin/env bash
# tests/long/coverage.sh [FOLDER]
# Line and branch coverage of the core (math, sweep, index, world, motion) by the core's own tests, built in FOLDER
# (build-coverage). Prints a line a file, with the lines that no test runs. Needs gcovr. About half an hour.
set -euo pipefail
source_folder=$(realpath "$(dirname "$0")/../..")
folder=$(realpath -m "${1:-$source_folder/build-coverage}")
command -v gcovr > /dev/null || { echo "there is no gcovr; as root: apt-get install gcovr" >&2; exit 77; }
cmake -S "$source_folder" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Coverage -DCMAKE_CXX_FLAGS_COVERAGE='-O1 --coverage -fprofile-update=atomic' \
  -DROAM_TOOLS=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON > /dev/null
cmake --build "$folder"
find "$folder" -name '*.gcda' -delete
ctest --test-dir "$folder" --output-on-failure --parallel "$(nproc)" --timeout 3600 --quiet
cd "$source_folder"
gcovr --root . --object-directory "$folder" --filter 'src/(math|sweep|index|world|motion)/' --exclude-throw-branches \
  --exclude-unreachable-branches "$folder"
