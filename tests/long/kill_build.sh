#!/usr/bin/env bash
# tests/long/kill_build.sh [KILLS [EVERY]]
# Kills `roam build` at KILLS (200) random moments, then at each (at EVERY-th; 0: at none) fsync and rename, before it
# and after it in turn; half of it for one thread, half for two. Each time it runs it again to the end and compares with
# a build that nobody disturbed. Three parts, more than one shard. About half an hour. Needs a C compiler.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
trap 'rm -rf "$work"' EXIT
kills=${1:-200}
every=${2:-1}
need_faults

"$roam" make gallery -o "$work/a.ply" --triangles 700k > /dev/null || exit 1
"$roam" make terrain -o "$work/b.ply" --triangles 500k --seed 2 > /dev/null || exit 1
"$roam" make city -o "$work/c.ply" --triangles 50k --seed 3 > /dev/null || exit 1
scene=("$work/a.ply" "$work/b.ply" "$work/c.ply")
build "$work/whole" > "$work/said" 2>&1 || { cat "$work/said"; exit 1; }
(($(find "$work/whole/packs" -type f | wc -l) > 1)) || complain "the scene is too small for several shards"
RANDOM=1

# again THREADS WHAT: what was killed is published and whole, or not published; the same command ends it.
again() {
  expect_whole_or_none "$work/killed" "$2"
  timeout 600 "$roam" build "${scene[@]}" -o "$work/killed" --threads "$1" > "$work/said" 2>&1 ||
    complain "$2: the build does not go on: $(tail -1 "$work/said")"
  expect_same "$work/killed" "$2"
  rm -rf "$work/killed"
}

killed=0 early=0
for threads in 1 2; do
  ((kills > 0)) || break
  start=$(date +%s%N)
  build "$work/timed" --threads $threads > /dev/null 2>&1
  whole_us=$((($(date +%s%N) - start) / 1000))
  expect_same "$work/timed" "$threads threads, undisturbed"
  rm -rf "$work/timed"
  for ((i = 0; i < kills / 2; ++i)); do
    # One in three is killed twice, the second time while it goes on from the first.
    for ((round = 0; round <= (i % 3 == 2); ++round)); do
      "$roam" build "${scene[@]}" -o "$work/killed" --threads $threads > /dev/null 2>&1 &
      builder=$!
      moment=$((whole_us * (RANDOM * 32768 + RANDOM) / (1 << 30)))
      sleep "$(printf '%d.%06d' $((moment / 1000000)) $((moment % 1000000)))"
      kill -9 $builder 2> /dev/null
      wait $builder 2> /dev/null
      if (($? == 137)); then killed=$((killed + 1)); else early=$((early + 1)); fi
    done
    again $threads "$threads threads, killed after $moment us"
    ((i % 20 != 19)) || echo "$threads threads: $((i + 1)) random moments; $wrong wrong; $SECONDS s"
  done
done
echo "random moments: killed $killed times, $early times it was done before; $wrong wrong; $SECONDS s"
((killed >= kills / 2)) || complain "killed only $killed times"

steps=0
for threads in 1 2; do
  ((every > 0)) || break
  # Both at last: $count is then of both.
  for calls in fsync rename fsync,rename; do
    rm -rf "$work/killed"
    counted $calls "$work/killed" --threads $threads
    expect_same "$work/killed" "$threads threads, counted"
  done
  rm -rf "$work/killed"
  for ((n = 1; n <= count; n += every)); do
    kind=$([[ $((steps % 2)) == 0 ]] && echo kill || echo after)
    faulty FAULT_CALLS=fsync,rename FAULT_AT=$n FAULT_KIND=$kind -- \
      "$roam" build "${scene[@]}" -o "$work/killed" --threads $threads > /dev/null 2>&1
    status=$?
    ((status == 137)) || complain "$threads threads, killed at step $n: status $status"
    steps=$((steps + 1))
    again $threads "$threads threads, killed at step $n of $count"
    ((steps % 20 != 0)) || echo "$threads threads: killed at $n of $count calls; $wrong wrong; $SECONDS s"
  done
  echo "$threads threads: killed up to call $count; $wrong wrong; $SECONDS s"
done
finish "killed at $killed random moments and $steps times at an fsync or rename"
