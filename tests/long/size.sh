#!/usr/bin/env bash
# tests/long/size.sh [SCENE.ply [STORE.roam]]
# A gallery of 130 M triangles, 3.3 GB (or SCENE, a gallery too): builds its store within --memory 1G, or takes STORE;
# then walks it with 64 MiB and cold files: ten simulated minutes at 50 m/s and at 1.4 m/s; both again from an nginx on
# this machine, if it is here; and both again, with every move of all ten minutes checked against all triangles of the
# scene. Unless moves are checked, the program takes at most 25 MiB more, by HTTP 32. Then the step time of 1e5, 1e6, 1e7 and 1.3e8
# triangles on the same way. Prints one line of figures each. 13 GB of disk, 20 minutes on two cores at rest. On a
# machine that is not at rest, UNDER="chrt -f 40" keeps other programs from interrupting the walks that are timed (not
# the builds, nor the checks).
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
source "$(dirname "$0")/../support/nginx.sh"
trap 'stop_nginx; rm -rf "$work"' EXIT

number() { sed -n "s/^ *\"$1\": \"\{0,1\}\([^,\"]*\)\"\{0,1\},\{0,1\}$/\1/p" "$2" | head -1; }
# Only these files: no other program is disturbed.
forget() { [[ ! -d $1 ]] || find "$1" -type f -exec dd if={} iflag=nocache count=0 status=none \;; }

# built SCENE STORE: with the largest sum of memory over the builder and its readers, looked at ten times a second.
built() {
  TIMEFORMAT='%U %S'
  { time "$roam" build "$1" -o "$2" --memory 1G --json > "$work/build.json" 2> "$work/said"; } 2> "$work/time" &
  local job=$! peak=0 now builder
  sleep 0.3
  builder=$(pgrep -P $job -x "$(basename "$roam")")
  while kill -0 $job 2> /dev/null; do
    now=$(ps -o rss= -p "$builder" --ppid "$builder" | awk '{sum += $1} END {print sum + 0}')
    ((now <= peak)) || peak=$now
    sleep 0.1
  done
  wait $job || complain "the build failed: $(tail -1 "$work/said")"
  read -r user system < "$work/time"
  echo "built $(number triangles "$work/build.json") triangles in $(number seconds "$work/build.json") s (read" \
    "$(number read_s "$work/build.json"), plan $(number plan_s "$work/build.json"), shards" \
    "$(number shard_s "$work/build.json"), merge $(number merge_s "$work/build.json")); processor $user + $system s;" \
    "$(number bytes_per_triangle "$work/build.json") bytes a triangle; memory at most $((peak / 1024)) MiB"
  ((peak > 0)) || complain "nobody saw the memory of the build"
  ((peak <= 1 << 20)) || complain "the build takes more than 1 GiB"
}

walks=0 pieces=0 violations=0 most=0 http='by HTTP'
# walked STORE WHAT OPTIONS...
walked() {
  local what=$2 report=$work/report more=25
  [[ $1 != http:* ]] || more=32
  forget "$1"
  TIMEFORMAT='%R %U %S'
  { time measured ${UNDER:-} "$roam" walk "$1" "${@:3}" --memory 64M --json > "$report" 2> "$work/said"; } \
    2> "$work/time"
  local status=$?
  # 3: held, or a violation, which the report has.
  ((status == 0 || status == 3)) || { complain "$what: status $status: $(tail -1 "$work/said")"; return; }
  read -r real user system < "$work/time"
  echo "$what: $(number outcome "$report"), $(number length_m "$report") m in $(number simulated_s "$report") simulated" \
    "s, $(number steps "$report") steps; step ns median $(number median "$report"), p99 $(number p99 "$report"), max" \
    "$(number max "$report"); throttled $(number throttled "$report"); violations $(number violations "$report")" \
    "in $(number pieces "$report") pieces and $(number distances "$report") distances;" \
    "memory $(number memory "$report"), used $(number used "$report"), loads $(number loads "$report"), evictions" \
    "$(number evictions "$report"), $(number bytes_read "$report") bytes read, failures $(number failures "$report");" \
    "the program $(cat "$work/peak") MiB; took $real s, processor $user + $system s"
  walks=$((walks + 1))
  if [[ " $* " == *" --against "* ]]; then
    pieces=$((pieces + $(number pieces "$report"))) violations=$((violations + $(number violations "$report")))
    (($(number pieces "$report") > 0)) || complain "$what: no move was checked"
  else
    (($(cat "$work/peak") <= most)) || most=$(cat "$work/peak")
    (($(cat "$work/peak") <= 64 + more)) || complain "$what: takes more than $more MiB more than it may keep"
  fi
  (($(number memory "$report") <= 64 << 20)) || complain "$what: more than 64 MiB"
  [[ $(number violations "$report") == 0 || $(number violations "$report") == null ]] || complain "$what: violations"
  grep -q '"overstated_clearances": [1-9]' "$report" && complain "$what: overstates a clearance"
  [[ $(number failures "$report") == 0 ]] || complain "$what: $(number last_failure "$report")"
  grep -qE '"length_m": [0-9.]*[1-9]' "$report" || complain "$what: it walks no way"
  [[ $(number outcome "$report") == reached ]] || complain "$what: $(number why "$report")"
}

big=${1:-$work/big.ply}
[[ -e $big ]] || "$roam" make gallery -o "$big" --triangles 130000000 || exit 1
store=${2:-$work/big.roam}
[[ -e $store/CURRENT ]] || built "$big" "$store"

# Along the paper's first two paths and back, 32 km; along the first, 840 m, and all of it.
for ((i = 0; i < 7; ++i)); do
  printf '%s\n' '-13739 253 182' '-12504 1566 182' '-12228 1927 182' '-12504 1566 182'
done > "$work/fly.path"
echo '-13739 253 182' >> "$work/fly.path"
printf '%s\n' '-13739 253 182' '-13163.5 864.9 182' > "$work/walk.path"
printf '%s\n' '-13739 253 182' '-12504 1566 182' > "$work/first.path"
fly=(--path "$work/fly.path" --mode fly --speed 50)
walk=(--path "$work/walk.path" --mode walk --speed 1.4 --height 1.8)
walked "$store" "fly, 50 m/s" "${fly[@]}"
walked "$store" "walk, 1.4 m/s" "${walk[@]}"
"$roam" publish "$store" "$work/www/big.roam" --nginx > "$work/big.conf" || exit 1
if start_nginx "$work/nginx" "$work/big.conf"; then
  forget "$work/www"
  walked "http://127.0.0.1:$port/big.roam" "fly, 50 m/s, by HTTP" "${fly[@]}"
  walked "http://127.0.0.1:$port/big.roam" "walk, 1.4 m/s, by HTTP" "${walk[@]}"
else
  http='by HTTP not, for nginx is not here'
fi
UNDER='' walked "$store" "fly, 50 m/s, against the scene" "${fly[@]}" --against "$big"
UNDER='' walked "$store" "walk, 1.4 m/s, against the scene" "${walk[@]}" --against "$big"

for triangles in 100000 1000000 10000000; do
  "$roam" make gallery -o "$work/g.ply" --triangles $triangles > /dev/null || exit 1
  "$roam" build "$work/g.ply" -o "$work/$triangles.roam" > /dev/null 2> "$work/said" || complain "$(tail -1 "$work/said")"
  rm "$work/g.ply"
done
for triangles in 100000 1000000 10000000; do
  walked "$work/$triangles.roam" "$triangles triangles" --path "$work/first.path" --mode fly --speed 50
done
walked "$store" "130 M triangles" --path "$work/first.path" --mode fly --speed 50
finish "$walks walks, $http, at most $most MiB; $violations violations in $pieces pieces"
