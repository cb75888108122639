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
# What it takes for uninitialised are arrays that are filled before they are read; what it wants initialised in a list is
# computed in the body.
cppcheck --enable=warning,performance,portability --error-exitcode=1 --quiet --std=c++20 --language=c++ -j "$(nproc)" \
  -I include -I src --inline-suppr --template='{file}:{line}: {id}: {message}' \
  --suppress={missingIncludeSystem,unknownMacro,toomanyconfigs,useInitializationList} \
  --suppress={uninitMemberVar,uninitDerivedMemberVar,uninitvar,uninitStructMember,ctuuninitvar} \
  --suppress={CastIntegerToAddressAtReturn,shiftTooManyBits,duplInheritedMember} "${files[@]}" || wrong=1
exit $wrong
