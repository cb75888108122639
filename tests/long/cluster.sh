#!/usr/bin/env bash
# tests/long/cluster.sh [TASKS [TRIANGLES [TROUBLES]]]
# Builds a store of terrains with TRIANGLES (44000000) together by arrays of TASKS (64), which read and build, on two nodes
# of a real Slurm on this machine. Meanwhile, TROUBLES (40) times: kills a task's program, cancels or requeues a task,
# drains a node, or takes its power away. Then compares with a build that nobody disturbed, and prints seconds of the steps
# and tasks.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
source "$(dirname "$0")/../support/slurm.sh"
tasks=${1:-64} triangles=${2:-44000000} troubles=${3:-40}
export XDG_DATA_HOME=$work/home
cd "$work" || exit 1
if ! start_slurm "$work/slurm"; then
  echo "Slurm does not run here; as root: apt-get install slurmctld slurmd slurm-client" >&2
  exit 77
fi
trap 'stop_slurm; rm -rf "$work"' EXIT
RANDOM=1
scene=()
# Four files for each task, of three sizes.
for ((i = 0; i < 4 * tasks; ++i)); do
  scene+=("$work/$i.ply")
  "$roam" make terrain -o "${scene[i]}" --triangles $((triangles * (1 + i % 3) / (8 * tasks))) --size 200 --seed "$i" \
    --origin "$((i % 16 * 200)),$((i / 16 * 200)),0" > /dev/null || exit 1
done
build "$work/whole" --threads 2 > said 2>&1 || { cat said; exit 1; }
grep . said

"$roam" cluster slurm "${scene[@]}" -o "$work/array" --shards "$tasks" --threads 1 --submit || exit 1
running() { squeue --noheader --array --states=running --name=roam-read,roam-tasks --format=%i; }
declare -A met=()
for ((met_all = 0; met_all < troubles;)); do
  [[ -n $(squeue --noheader) ]] || break
  sleep "0.$((RANDOM % 10))"
  mapfile -t now < <(running)
  ((${#now[@]} > 0)) || continue
  task=${now[RANDOM % ${#now[@]}]}
  node=$((RANDOM % 2))
  node=$([[ $node == 0 ]] && echo one || echo two)
  kinds=(kill kill requeue requeue requeue cancel drain power)
  kind=${kinds[RANDOM % ${#kinds[@]}]}
  case $kind in
    kill) scancel --signal=KILL --full "$task" ;;
    requeue) scontrol requeue "$task" ;;
    cancel) scancel "$task" ;;
    drain)
      scontrol update nodename="$node" state=drain reason=test
      sleep 2
      scontrol update nodename="$node" state=resume
      ;;
    power)
      stop_node "$node"
      scontrol update nodename="$node" state=down reason=test
      sleep 1
      start_node "$node"
      slurm_waits 30 "[[ \$(sinfo --noheader --nodes=$node --format=%T) != down* ]]" ||
        scontrol update nodename="$node" state=resume
      ;;
  esac > out 2>&1 && met[$kind]=$((${met[$kind]:-0} + 1)) && met_all=$((met_all + 1))
done
slurm_waits 7200 '[[ -z $(squeue --noheader) ]]' || complain "the jobs do not end"
((met_all == troubles)) || complain "the jobs ended after $met_all of $troubles troubles"
for kind in "${!met[@]}"; do echo "$kind: ${met[$kind]} times"; done

# The merge names the tasks that were killed for good, and the same jobs again end the build.
said=$(cat slurm-*.out)
if [[ ! -e array/CURRENT ]]; then
  missing=$(grep -o 'missing shards: .*, in tasks [0-9,.-]* of' <<< "$said" | tail -1)
  [[ $missing ]] && echo "$missing $tasks" || complain "the merge says nothing: $(tail -n 1 <<< "$said")"
  "$roam" cluster slurm "${scene[@]}" -o "$work/array" --shards "$tasks" --threads 1 --submit || exit 1
  slurm_waits 7200 '[[ -z $(squeue --noheader) ]]' || complain "the jobs do not end the second time"
fi
expect_same "$work/array" "an array of $tasks tasks, $met_all troubles"
expect_whole_or_none "$work/array" "an array"

# Seconds of each step, alone on this machine.
number() { grep -o "\"$1\": [0-9.]*" "$2" | head -1 | cut -d' ' -f2; }
# timed OPTIONS: wall and processor seconds of each task with them.
timed() {
  local i TIMEFORMAT='%R %U %S'
  for ((i = 0; i < tasks; ++i)); do
    { time "$roam" build -o "$work/timed" --shard $i --threads 1 "$@" > /dev/null 2>&1; } 2>&1
  done
}
timed --plan "$tasks" "${scene[@]}" > shares
build "$work/timed" --plan "$tasks" --threads 2 --json > plan.json 2> /dev/null
(($(number parts_read plan.json) == 0)) || complain "the plan had to read"
timed > times
"$roam" build -o "$work/timed" --merge --threads 2 --json > merge.json 2> /dev/null
expect_same "$work/timed" "tasks one after the other"
awk -v plan="$(number seconds plan.json)" -v balance="$(number balance plan.json)" -v merge="$(number seconds merge.json)" '
  { kind = FILENAME; wall[kind] += $1; cpu[kind] += $2 + $3; ++n[kind]; if ($2 + $3 > most[kind]) most[kind] = $2 + $3 }
  END {
    for (kind in n) {
      printf "%s: %d, %.1f s one after the other, processor %.1f s, %.2f s each, longest %.2f times the mean\n", kind,
        n[kind], wall[kind], cpu[kind], cpu[kind] / n[kind], most[kind] * n[kind] / cpu[kind]
      all += wall[kind]
    }
    printf "plan %.2f s (longest task %s times the mean, by triangles), merge %.2f s; together %.1f %% of all\n", plan,
      balance, merge, 100 * (plan + merge) / (all + plan + merge)
  }' shares times
finish "$tasks tasks, $met_all troubles"
