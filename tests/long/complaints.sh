# What the long tests share. Sourced; the caller's folder of work is $work, and goes when it ends.
#
#   ROAM=FILE   the program (default: build-check/roam)
#   TMPDIR      where scenes and stores are made

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
roam=$(realpath "${ROAM:-$here/../../build-check/roam}")
if [[ ! -x $roam ]]; then
  echo "There is no $roam: run ./check first, or name the program by ROAM." >&2
  exit 1
fi
work=$(mktemp -d)
wrong=0

# Failures are counted, not the end: a long test tells all it finds.
complain() {
  wrong=$((wrong + 1))
  echo "WRONG: $*" >&2
}

# Needs strace, and the right to trace.
need_strace() {
  if ! strace -qq -e trace=none true 2> /dev/null; then
    echo "strace is not there or may not trace here; as root: apt-get install strace" >&2
    exit 77
  fi
}

# Makes $work/faults.so, which makes calls go wrong: see faults.c.
need_faults() {
  "${CC:-cc}" -O1 -Wall -Wextra -shared -fPIC -o "$work/faults.so" "$here/faults.c" || exit 1
}

# content STORE: what a store consists of, without the lock and what is remembered of the dates of the scene's files.
content() {
  (cd "$1" && find . -type f ! -name LOCK ! -name sources.json -print0 | sort -z | xargs -0 sha256sum)
}

# expect_same STORE WHAT: whether it is $work/whole, to the last byte and the last file.
expect_same() {
  if ! diff <(content "$work/whole") <(content "$1") > "$work/diff" 2>&1; then
    complain "$2: not the same as an uninterrupted build"
    head -5 "$work/diff" >&2
  fi
}

# Whether STORE is not there, or is whole: what a reader must find at any moment.
expect_whole_or_none() {
  [[ ! -e $1/CURRENT ]] || "$roam" verify "$1" > "$work/verify" 2>&1 || complain "$2: published and not whole"
}

# faulty NAME=VALUE... -- COMMAND...: the command with calls that go wrong in `roam`, or in $fault_program; its exit
# status. A reader gets none of the environment, so that a script which sets it anew stands in for one.
faulty() {
  local -a settings=()
  while [[ $1 != -- ]]; do
    settings+=("$1")
    shift
  done
  shift
  settings+=(LD_PRELOAD="$work/faults.so" FAULT_PROGRAM="${fault_program:-$(basename "$roam")}")
  if [[ ${fault_program:-} == roam-reader ]]; then
    printf '#!/bin/sh\nexec env %s %q "$@"\n' "$(printf '%q ' "${settings[@]}")" "$(dirname "$roam")/roam-reader" \
      > "$work/reader"
    chmod +x "$work/reader"
    settings=(ROAM_READER="$work/reader")
  fi
  env "${settings[@]}" timeout 300 "$@"
}

# counted CALLS OUTPUT [OPTIONS...]: how many of these calls a build makes. None is a fault that nobody would meet.
counted() {
  faulty FAULT_CALLS="$1" FAULT_COUNT="$work/count" -- "$roam" build "${scene[@]}" -o "${@:2}" > "$work/said" 2>&1 ||
    complain "counting $1: $(tail -1 "$work/said")"
  count=$(< "$work/count")
  ((count > 0)) || complain "a build makes no call of $1"
}

# measured COMMAND...: with its largest size in MiB in $work/peak.
measured() {
  /usr/bin/python3 -c '
import resource, subprocess, sys
status = subprocess.run(sys.argv[2:]).returncode
open(sys.argv[1], "w").write(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss >> 10))
sys.exit(status)' "$work/peak" "$@"
}

# build OUTPUT [OPTIONS...]: the scene of the test.
build() {
  local output=$1
  shift
  "$roam" build "${scene[@]}" -o "$output" "$@"
}

finish() {
  echo "$1; $wrong wrong; $SECONDS s"
  ((wrong == 0))
}
