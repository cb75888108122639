#!/usr/bin/env bash
# tests/long/failing_disk.sh [RUNS]
# Makes `roam build` and its reader meet a disk that fails: at the N-th call of one kind, up to RUNS (100) of them spread
# over all that there are, with each of several errors, once and from there on; with every call short or interrupted; on
# a file system that is full, or read-only; with a limit on the size of files; and with two builders at once. Each time
# either the store is whole and the same as ever, with exit status 0, or status 1 and a message that names the file and
# the cause; and the same command without faults completes it. About half an hour. Needs a C compiler; as root also
# mounts file systems in memory of its own, and uses strace where it is there.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
mounted=
trap '[[ -z $mounted ]] || umount "$mounted"; rm -rf "$work"' EXIT
runs=${1:-100}
need_faults

"$roam" make gallery -o "$work/a.ply" --triangles 20k > /dev/null || exit 1
"$roam" make terrain -o "$work/b.obj" --triangles 10k --seed 2 > /dev/null || exit 1
scene=("$work/a.ply" "$work/b.obj")
build "$work/whole" > "$work/said" 2>&1 || { cat "$work/said"; exit 1; }

# judge STATUS OUTPUT WHAT [CAUSE]: what a build that met a fault has done, and that it can be gone on with.
judge() {
  local status=$1 output=$2 what=$3 cause=${4:-}
  case $status in
    0) # What cannot be removed of the scratch folder goes with the next build, and is no part of the store.
      if [[ -e $output/scratch ]]; then
        leftovers=$((leftovers + 1))
        rm -rf "$work/published"
        cp -r "$output" "$work/published"
        rm -rf "$work/published/scratch"
        expect_same "$work/published" "$what, done"
      else
        expect_same "$output" "$what, done"
      fi
      ;;
    1)
      grep -q . "$work/said" || complain "$what: no message"
      [[ -z $cause ]] || grep -qi -- "$cause" "$work/said" || complain "$what: not the cause: $(tail -1 "$work/said")"
      grep -qE "/|roam-reader" "$work/said" || complain "$what: names no file: $(tail -1 "$work/said")"
      refused=$((refused + 1))
      ;;
    124) complain "$what: hangs" ;;
    *) complain "$what: status $status: $(tail -1 "$work/said")" ;;
  esac
  expect_whole_or_none "$output" "$what"
}
again() {
  timeout 300 "$roam" build "${scene[@]}" -o "$1" > "$work/said" 2>&1 ||
    complain "$2: does not go on: $(tail -1 "$work/said")"
  expect_same "$1" "$2, gone on with"
  rm -rf "$1"
}

# errno, its text in messages, and what calls can fail so.
declare -A text=([28]="No space left" [5]="nput/output error" [4]="Interrupted" [24]="[Tt]oo many" [122]="quota")
declare -A errors=([write]="28 5 4 122" [pwrite]="5 4" [truncate]="5" [fsync]="28 5 4" [rename]="28 5"
  [rename,link]="28 5" [open]="28 5 4 24" [read]="5 4" [pread]="5 4" [mkdir]="28 5" [unlink]="5")
total=0 refused=0 leftovers=0
for program in "$(basename "$roam")" roam-reader; do
  fault_program=$program
  refused_before=$refused
  # A file that cannot be renamed is linked to its name.
  calls="write pwrite truncate fsync rename rename,link open read pread mkdir unlink"
  [[ $program != roam-reader ]] || calls="open read"
  for call in $calls; do
    # The reader writes no count.
    count=40
    [[ $program == roam-reader ]] || counted $call "$work/s"
    rm -rf "$work/s"
    for error in ${errors[$call]}; do
      tried=$((count < runs ? count : runs))
      for ((i = 0; i < tried; ++i)); do
        at=$((1 + (tried > 1 ? (count - 1) * i / (tried - 1) : 0)))
        what="$program, $call $at of $count, error $error"
        on=()
        # A call that is interrupted for ever is no fault that a disk has.
        if ((i % 2 == 1 && error != 4)); then
          on=(FAULT_ON=1)
          what+=", and all after it"
        fi
        faulty FAULT_CALLS=$call FAULT_AT=$at FAULT_KIND=$error "${on[@]}" -- \
          "$roam" build "${scene[@]}" -o "$work/s" > "$work/said" 2>&1
        status=$?
        total=$((total + 1))
        # What the reader says is passed on; it words causes in its own way.
        cause=${text[$error]}
        [[ $program != roam-reader ]] || cause=
        judge $status "$work/s" "$what" "$cause"
        ((error != 4 || status == 0 || $(grep -c "$call" <<< "write pwrite fsync read pread") == 0)) ||
          complain "$what: an interrupted call is not called again: $(tail -1 "$work/said")"
        again "$work/s" "$what"
      done
    done
    echo "$program: $call, $count calls; $total faults, $refused refused; $wrong wrong; $SECONDS s"
  done
  ((refused > refused_before)) || complain "no fault has reached $program"
done

for program in "$(basename "$roam")" roam-reader; do
  fault_program=$program
  faulty FAULT_KIND=short -- "$roam" build "${scene[@]}" -o "$work/s" > "$work/said" 2>&1
  status=$?
  ((status == 0)) || complain "$program, all reads and writes short or interrupted: $(tail -1 "$work/said")"
  judge $status "$work/s" "$program, all reads and writes short or interrupted"
  rm -rf "$work/s"
done

# The same through the kernel's door, for the calls that do not go through the C library's.
if strace -qq -e trace=none true 2> /dev/null; then
  for call in openat read write pread64; do
    for n in 1 2 3 5 8 13 21 34 55 89 144 233; do
      timeout 300 strace -f -qqq -o /dev/null -e trace=$call -e inject=$call:error=EIO:when=$n \
        "$roam" build "${scene[@]}" -o "$work/s" > "$work/said" 2>&1
      status=$?
      total=$((total + 1))
      # Before main it is the loader of programs that refuses.
      if ((status != 127)) || ! grep -q "shared librar" "$work/said" || [[ -e $work/s ]]; then
        judge $status "$work/s" "strace, $call $n of a thread"
      fi
      again "$work/s" "strace, $call $n of a thread"
    done
  done
  echo "strace: $total faults, $refused refused; $wrong wrong; $SECONDS s"
fi

# Not even the message can be written.
for scene_now in "${scene[0]}" "$work/nothing.ply"; do
  "$roam" build "$scene_now" -o "$work/s" > /dev/full 2>&1
  status=$?
  ((status == 1)) || complain "$scene_now, with all it says on a full disk: status $status"
  rm -rf "$work/s"
done

# A limit on the size of files stands in for a quota; what goes over it is written short first.
for kib in 1 8 32 64 96 200 400; do
  (
    trap '' XFSZ
    ulimit -f $kib
    exec timeout 300 "$roam" build "${scene[@]}" -o "$work/s" 2>&1
  ) | cat > "$work/said"
  status=${PIPESTATUS[0]}
  total=$((total + 1))
  judge $status "$work/s" "files of $kib KiB at most" "File too large"
  again "$work/s" "files of $kib KiB at most"
done

if (($(id -u) == 0)) && mkdir "$work/disk" && mount -t tmpfs -o size=4k none "$work/disk" 2> /dev/null; then
  mounted=$work/disk
  for kib in 4 8 16 32 64 128 256 384 512 640 768 896 1024 1280 1536 2048; do
    mount -o remount,size=${kib}k "$work/disk"
    timeout 300 "$roam" build "${scene[@]}" -o "$work/disk/s" > "$work/said" 2>&1
    status=$?
    total=$((total + 1))
    judge $status "$work/disk/s" "a disk of $kib KiB" "No space left"
    ((status != 0)) || break
  done
  ((status == 0)) || complain "the disk of $kib KiB is still too small"
  # What was left at one size is gone on with at the next; and from nothing, at each size.
  for kib in 4 64 256 512 640; do
    rm -rf "$work/disk/s"
    mount -o remount,size=${kib}k "$work/disk"
    timeout 300 "$roam" build "${scene[@]}" -o "$work/disk/s" > "$work/said" 2>&1
    judge $? "$work/disk/s" "a disk of $kib KiB, from nothing" "No space left"
    mount -o remount,size=4m "$work/disk"
    again "$work/disk/s" "a disk of $kib KiB, then of 4 MiB"
  done
  echo "full disk: $total faults, $refused refused; $wrong wrong; $SECONDS s"

  mount -o remount,ro "$work/disk"
  timeout 60 "$roam" build "${scene[@]}" -o "$work/disk/s" > "$work/said" 2>&1
  (($? == 1)) && grep -q "Read-only" "$work/said" || complain "read-only disk: $(tail -1 "$work/said")"
  mount -o remount,rw "$work/disk"
  build "$work/disk/s" > /dev/null 2>&1
  mount -o remount,ro "$work/disk"
  # A store that is up to date can be asked for where nothing can be written, or is refused by name; it is not harmed.
  timeout 60 "$roam" build "${scene[@]}" -o "$work/disk/s" > "$work/said" 2>&1
  status=$?
  ((status == 0)) || { ((status == 1)) && grep -q "Read-only" "$work/said"; } ||
    complain "a store on a read-only disk: $(tail -1 "$work/said")"
  expect_same "$work/disk/s" "a store on a read-only disk"
  "$roam" verify "$work/disk/s" > "$work/said" 2>&1 || complain "verifying on a read-only disk: $(tail -1 "$work/said")"
  umount "$work/disk" && mounted=
else
  mkdir -p "$work/closed" && chmod a-w "$work/closed"
  build "$work/closed/s" > "$work/said" 2>&1
  (($? == 1)) && grep -q "Permission" "$work/said" || complain "read-only folder: $(tail -1 "$work/said")"
fi

# Two builders of one store: one builds, the other is told so, or comes when it is done.
both=0
for ((i = 0; i < 50; ++i)); do
  build "$work/s" > "$work/said.1" 2>&1 &
  first=$!
  sleep "0.0$((i % 10))"
  build "$work/s" > "$work/said.2" 2>&1
  second=$?
  wait $first
  first=$?
  for pair in "$first .1" "$second .2"; do
    read -r status name <<< "$pair"
    ((status == 0)) || { ((status == 1)) && grep -q "is being built by" "$work/said$name"; } ||
      complain "two builders: status $status: $(tail -1 "$work/said$name")"
  done
  ((first == 0 || second == 0)) || complain "two builders, and none builds"
  ((first != 0 || second != 0)) || both=$((both + 1))
  expect_same "$work/s" "two builders"
  rm -rf "$work/s"
done
echo "two builders: 50 times, $both times one after the other"
finish "$total faults, $refused refused, scratch left behind $leftovers times by builds that were done"
