#!/usr/bin/env bash
# tests/long/ctest.sh FOLDER [CTEST OPTIONS...]
# Runs the tests that are built in FOLDER. The last line has the figures. Status 1 if a test fails, or if all are skipped.
set -uo pipefail
folder=$(realpath "$1")
shift
ctest --test-dir "$folder" --output-on-failure --no-tests=error --parallel "$(nproc)" \
  --output-junit "$folder/tests.xml" "$@" < /dev/null
status=$?
# number NAME: of the report's first element, which counts.
number() { grep -m 1 -oE "\b$1=\"[0-9]+\"" "$folder/tests.xml" | tr -dc 0-9; }
tests=$(number tests) failed=$(number failures) skipped=$(number skipped)
passed=$((tests - failed - skipped - $(number disabled)))
echo "$passed tests passed, $skipped skipped, $failed failed"
((status == 0 && passed > 0))
