#!/usr/bin/env bash
# tests/long/serving.sh [STORE.roam PATH.path]
# A store of a gallery of 10 M triangles (or STORE, with a path through it) on a web server. First a flight at each
# latency and rate, whose places must be those on the disk to the last digit, by tests/programs/misbehaving_web_server.py: not
# every kernel has netem. Then 10, 100 and 1000 simulated walkers on one nginx: what they load a metre, how long a tile
# takes, and the time that nginx computes. BENCH_SERVING names bench_serving. Prints one line each. Ten minutes.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
source "$(dirname "$0")/../support/nginx.sh"
bench=$(realpath "${BENCH_SERVING:-$here/../../build-check/bench_serving}")
trap 'stop_nginx; [[ ! ${slow:-} ]] || kill $slow; rm -rf "$work"' EXIT
unset http_proxy all_proxy

store=${1:-$work/gallery.roam} path=${2:-$work/gallery-straight.path}
if [[ ! -e $store/CURRENT ]]; then
  (cd "$work" && "$roam" make gallery -o gallery.ply --triangles 10M > /dev/null &&
    "$roam" build gallery.ply -o gallery.roam > said 2>&1 && rm gallery.ply) || exit 1
fi
"$roam" publish "$store" "$work/www/x.roam" --nginx > "$work/location" || exit 1

flights=-1 most_walkers=0  # the first flight is on the disk
# flown STORE WHAT
flown() {
  local status
  flights=$((flights + 1))
  rm -f "$work/trace"
  TIMEFORMAT=%R
  { time "$roam" walk "$1" --path "$path" --mode fly --speed 50 --json --trace "$work/trace" > "$work/report" \
    2> "$work/said"; } 2> "$work/time"
  status=$?
  ((status == 0)) && grep -q '"outcome": "reached"' "$work/report" ||
    complain "$2: status $status: $(tail -1 "$work/said")"
  cut -d, -f1-7,9- "$work/trace" > "$work/places"  # without what is certified of the clearance
  echo "$2: $(grep -m1 '"outcome"' "$work/report" | cut -d'"' -f4), took $(cat "$work/time") s"
}
flown "$store" disk
mv "$work/places" "$work/right"
exec {input}> >(exec /usr/bin/python3 -B "$here/../programs/misbehaving_web_server.py" "$work/www" > "$work/port")
slow=$!
until [[ -s $work/port ]]; do
  kill -0 $slow 2> /dev/null || { echo "the slow web server does not start" >&2; exit 1; }
  sleep 0.1
done
for mode in good late20 late100 late1000 rate1250; do
  flown "http://127.0.0.1:$(cat "$work/port")/$mode/x.roam" $mode
  cmp "$work/right" "$work/places" || complain "$mode: not the flight on the disk"
done

if ! start_nginx "$work/nginx" "$work/location"; then
  echo "walkers: skipped, for nginx is not here"
elif [[ ! -x $bench ]]; then
  echo "walkers: skipped, for there is no $bench"
else
  worker=$(pgrep -P "$(cat "$work/nginx/pid")")
  clock() { awk -v a="$(getconf CLK_TCK)" '{ print ($14 + $15) / a }' "/proc/$worker/stat"; }
  # Each walker has a connection, and a few more files of its own.
  ulimit -n 16384 2> /dev/null
  for walkers in 10 100 1000; do
    "$bench" "http://127.0.0.1:$port/x.roam" --path "$path" --walkers $walkers > "$work/walked" &
    job=$!
    until [[ -s $work/walked ]]; do
      kill -0 $job 2> /dev/null || { complain "$walkers walkers do not start"; continue 2; }
      sleep 0.1
    done
    sleep 30
    before=$(clock) lines=$(wc -l < "$work/nginx/requests")
    sleep 59
    after=$(clock) now=$(wc -l < "$work/nginx/requests")
    wait $job || complain "$walkers walkers: a tile did not come"
    tail -1 "$work/walked"
    most_walkers=$walkers
    echo "  nginx: $(((now - lines) / 59)) requests a second, $(awk "BEGIN { print ($after - $before) / 0.59 }") % of a core"
  done
fi
finish "$flights slow flights as on the disk, at most $most_walkers walkers"
