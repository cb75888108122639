#!/usr/bin/env bash
# Whether the long proofs see what they are to see.
#   long_run.sh SOURCE WORK Run            results are of the files that are there, or there are none
set -euo pipefail
source=$1 folder=$2/$3 roam=${4:-}
rm -rf "$folder"
mkdir -p "$folder"
folder=$(realpath "$folder")
fail() { echo "$1"; exit 1; }
# says TEXT FILE
says() { grep -qF -- "$1" "$2" || { cat "$2"; fail "does not say: $1"; }; }

# program FILE: standard input as a program.
program() { cat > "$1" && chmod +x "$1"; }

case $3 in
  Run)
    # A build of a program that says what it was made of.
    mkdir -p "$folder/tree/tests/long" "$folder/tree/tests/fuzz"
    cd "$folder/tree"
    cp "$source/tests/long/run" tests/long
    cp "$source/tests/fuzz/text.cpp" tests/fuzz
    printf '/build-check/\n/build-long/\n' > .gitignore
    printf '| proof |\n' > tests/long/results.md
    program tests/long/certificates.sh <<< '#!/bin/bash
[[ ! ${CHANGES:-} ]] || echo "$CHANGES" > made-of
echo "made of $(< build-check/roam)"'
    cat > CMakeLists.txt << 'END'
cmake_minimum_required(VERSION 3.22)
project(made LANGUAGES NONE)
add_custom_command(OUTPUT roam COMMAND cp ${PROJECT_SOURCE_DIR}/made-of roam DEPENDS made-of)
add_custom_target(roam_app DEPENDS roam)
add_custom_target(roam-reader)
END
    echo one > made-of
    git init -q .
    git add .
    git -c user.name=x -c user.email=x@x commit -qm one
    cmake -G Ninja -S . -B build-check > "$folder/log"
    cmake --build build-check --target roam_app > "$folder/log"

    echo two > made-of
    tests/long/run build-long certificates > "$folder/log" || { cat "$folder/log"; fail "the proof does not pass"; }
    says 'passed | 0 | made of two |' tests/long/results.md
    echo three > made-of
    if CHANGES=four tests/long/run build-long certificates > "$folder/log"; then fail "passes though files changed"; fi
    says 'no result, files have changed meanwhile' "$folder/log"
    says 'made of two' tests/long/results.md
    tests/long/run build-long certificates > "$folder/log" || { cat "$folder/log"; fail "the proof does not pass any more"; }
    says 'passed | 0 | made of four |' tests/long/results.md
    ;;
esac
