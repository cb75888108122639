#!/usr/bin/env bash
# Whether the long proofs see what they are to see.
#   long_run.sh SOURCE WORK Faults ROAM    the faults of failing_disk.sh reach roam, by each name that C has for a call
#   long_run.sh SOURCE WORK Run            results are of the files that are there, or there are none
#   long_run.sh SOURCE WORK Scripts        a program that proves nothing passes no proof
#   long_run.sh SOURCE WORK Fuzzing        a finding leaves no files in memory
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
  Faults)
    export ROAM=$roam TMPDIR=$folder
    set +e
    source "$source/tests/long/complaints.sh"
    need_faults
    "$roam" make gallery -o "$work/a.ply" --triangles 10k > /dev/null
    scene=("$work/a.ply")
    calls=$(sed -n 's/^  calls="\(.* .* .*\)"$/\1/p' "$source/tests/long/failing_disk.sh")
    (($(wc -w <<< "$calls") > 8)) || fail "failing_disk.sh was not understood"
    for call in $calls; do
      counted "$call" "$work/s"
      echo "$call: $count"
      rm -rf "$work/s"
      # Where each of them fails, there is a message, or the build does without.
      faulty FAULT_CALLS="$call" FAULT_AT=1 FAULT_ON=1 FAULT_KIND=5 -- "$roam" build "${scene[@]}" -o "$work/s" \
        > "$work/said" 2>&1
      ((status = $?, status <= 1)) || complain "$call fails: status $status"
      [[ $call != rename,link && $call != mkdir ]] || grep -q "nput/output error" "$work/said" ||
        complain "$call fails, and nobody says so"
      rm -rf "$work/s"
    done
    # Whatever of these roam calls can go wrong.
    names='p?(read|write)v?|open(at)?|f?truncate|f(data)?sync|rename(at2?)?|link(at)?|mkdir(at)?|unlink(at)?|remove|rmdir'
    names+='|symlink(at)?|copy_file_range|sendfile|(posix_)?fallocate'
    undefined=$(nm -D --undefined-only "$roam" | grep -oE " U ($names)(64)?(@|$)" | grep -oE '[a-z]+[a-z_0-9]*')
    defined=$(nm -D --defined-only "$work/faults.so" | awk '{ print $3 }')
    grep -q renameat <<< "$undefined" || complain "no call of roam was understood"
    missing=$(grep -vxF "$defined" <<< "$undefined") && complain "cannot go wrong: $missing"
    rm -rf "$work"
    finish "$(wc -w <<< "$calls") kinds of calls"
    ;;

  Run)
    # A build of a program that says what it was made of.
    mkdir -p "$folder/tree/tests/long" "$folder/tree/tests/fuzz"
    cd "$folder/tree"
    cp "$source"/tests/long/{run,mutants.py} tests/long
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

  Scripts)
    cp -r --parents "$source"/tests/{long,support,programs} "$folder"
    cd "$folder/$source"
    mkdir "$folder/bin"
    export PATH=$folder/bin:$PATH TMPDIR=$folder ROAM=$folder/roam
    # Its walks are held at their start, and those over the web fail.
    program "$folder/roam" << 'END'
#!/bin/bash
output=$2
for ((i = 1; i <= $#; ++i)); do
  [[ ${!i} != -o && ${!i} != --trace ]] || { k=$((i + 1)); output=${!k}; }
done
case $1 in
  make) : > "$output" ;;
  build | cluster)
    [[ $output != --* ]] || exit 0
    mkdir -p "$output/packs"
    head -c 9999 /dev/zero > "$output/packs/x.pack"
    : > "$output/CURRENT"
    echo '"parts_read": 0, "seconds": 1, "balance": 1'
    ;;
  publish) mkdir -p "$3" ;;
  verify) [[ -e $2/packs/x.pack ]] || exit 3 ;;
  walk)
    [[ $2 != http:* ]] || { echo 'cannot be reached' >&2; exit 1; }
    [[ $output == "$2" ]] || echo '1,2,3,4,5,6,7,8,9' > "$output"
    printf '  "%s": %s,\n' outcome '"reached"' violations 0 overstated_clearances 0 failures 0 failed 0 memory 9 pieces 0 length_m 0
    [[ $* == *--trace* ]] || exit 3
    ;;
esac
END
    # fails TEXT COMMAND...: the script ends with status 1 and says so.
    fails() {
      local status=0
      "${@:2}" > "$folder/log" 2>&1 < /dev/null || status=$?
      ((status == 1)) || { cat "$folder/log"; fail "$2: status $status"; }
      says "$1" "$folder/log"
    }

    mkdir "$folder/store"
    touch "$folder/store/CURRENT" "$folder/way"
    BENCH_SERVING=$folder/none fails 'WRONG: good: status 1: cannot be reached' \
      tests/long/serving.sh "$folder/store" "$folder/way"

    program "$folder/bin/strace" << 'END'
#!/bin/bash
while [[ $1 == -* ]]; do
  [[ $1 != -[eo] ]] || shift
  shift
done
exec "$@"
END
    fails 'WRONG: fly, undisturbed: does not reach its end' tests/long/failing_reads.sh 0
    says 'WRONG: fly, undisturbed: no move was checked' "$folder/log"
    says 'WRONG: fly, undisturbed: unchecked, status 3, it walks no way' "$folder/log"
    says 'WRONG: walk, pread64 error=EIO:when=20+2: no read has failed' "$folder/log"
    fails 'WRONG: one read in three fails: no read has failed' \
      tests/long/failing_store.sh "$folder/way" "$folder/store" "$folder/way" 0
    says 'WRONG: one read in three fails: unchecked, status 3, it flies no way' "$folder/log"

    cat > tests/support/slurm.sh <<< 'start_slurm() { :; }; stop_slurm() { :; }; slurm_waits() { :; }; squeue() { :; }'
    fails 'WRONG: the jobs ended after 0 of 3 troubles' tests/long/cluster.sh 2 16 3
    says '2 tasks, 0 troubles' "$folder/log"
    ;;

  Fuzzing)
    program "$folder/finds" << 'END'
#!/bin/bash
echo "$TMPDIR" > "$0.folder"
touch "$TMPDIR/left"
exit 77
END
    status=0
    "$source/tests/fuzz/check.sh" "$folder/finds" walk "$folder/work" || status=$?
    ((status == 77)) || fail "a finding has the status $status"
    [[ $(< "$folder/finds.folder") == /*/* && ! -e $(< "$folder/finds.folder") ]] || fail "the files are still there"
    ;;
esac
