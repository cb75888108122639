#!/usr/bin/env bash
# tests/long/lint.sh [FILE...]
# clang-tidy (.clang-tidy) and cppcheck on FILEs (all of src and apps that there are, and the headers they include). Both
# must find nothing. Half an hour.
set -uo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
for tool in clang-tidy cppcheck; do
  command -v "$tool" > /dev/null || { echo "there is no $tool; as root: apt-get install clang-tidy cppcheck" >&2; exit 77; }
done
files=("$@")
((${#files[@]})) || mapfile -t files < <(git ls-files 'src/*.cpp' 'apps/*.cpp')
wrong=0
configure() { cmake -S . -B build-lint -G Ninja -DCMAKE_BUILD_TYPE=Release -DROAM_UNITY=OFF -DROAM_BENCH=OFF; }
configure > /dev/null || exit 1
# Each finding once, though many files include its header.
tidied=$(printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build-lint --quiet 2>&1)
findings=$(grep -E '(warning|error):' <<< "$tidied" | sort -u)
# One count of warnings a file: clang-tidy has run.
if [[ $findings ]] || (($(grep -c 'warnings\? generated' <<< "$tidied") < ${#files[@]})); then
  wrong=1
  echo "${findings:-$tidied}"
fi
checked=$(cppcheck --enable=warning,performance,portability --error-exitcode=1 --quiet --std=c++20 --language=c++ \
  -j "$(nproc)" -I include -I src --inline-suppr --suppressions-list=tests/long/cppcheck.txt \
  --template='{file}:{line}: {id}: {message}' "${files[@]}" 2>&1) || wrong=1
[[ ! $checked ]] || echo "$checked"
echo "${#files[@]} files: clang-tidy finds $(grep -c . <<< "$findings"), cppcheck $(grep -c . <<< "$checked")"
exit $wrong
