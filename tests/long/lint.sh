#!/usr/bin/env bash
# tests/long/lint.sh [FILE...]
# clang-tidy (.clang-tidy) and cppcheck on FILEs (all of src and apps that build-check compiles, the headers they include,
# too). Both must be silent. build-check must have been configured with ROAM_UNITY=OFF. About half an hour.
set -uo pipefail
cd "$(dirname "$(realpath "$0")")/../.."
for tool in clang-tidy cppcheck; do
  command -v "$tool" > /dev/null || { echo "there is no $tool; as root: apt-get install clang-tidy cppcheck" >&2; exit 2; }
done
files=("$@")
((${#files[@]})) || mapfile -t files < <(git ls-files 'src/*.cpp' 'apps/*.cpp')
wrong=0
# Each finding once, though many files include its header.
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build-check --quiet 2> /dev/null |
  grep -E '(warning|error):' | sort -u | tee /dev/stderr | grep -q . && wrong=1
# What it takes for uninitialised are arrays that are filled before they are read; what it wants initialised in a list is
# computed in the body.
cppcheck --enable=warning,performance,portability --error-exitcode=1 --quiet --std=c++20 --language=c++ -j "$(nproc)" \
  -I include -I src --inline-suppr --template='{file}:{line}: {id}: {message}' \
  --suppress={missingIncludeSystem,unknownMacro,toomanyconfigs,useInitializationList} \
  --suppress={uninitMemberVar,uninitDerivedMemberVar,uninitvar,uninitStructMember,ctuuninitvar} \
  --suppress={CastIntegerToAddressAtReturn,shiftTooManyBits,duplInheritedMember} "${files[@]}" || wrong=1
exit $wrong
