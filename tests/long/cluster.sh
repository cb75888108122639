#!/usr/bin/env bash
# tests/long/cluster.sh [TASKS [TRIANGLES [TROUBLES]]]
# Builds a store of four terrains of TRIANGLES (11M) each as an array of TASKS (64) on two nodes of a real Slurm on this
# machine. Meanwhile, TROUBLES (40) times: kills a task's program, cancels or requeues a task, drains a node, or takes its
# power away. Then compares with a build that nobody disturbed, and prints seconds of the steps and tasks.
set -uo pipefail
source "$(dirname "$0")/complaints.sh"
source "$(dirname "$0")/../support/slurm.sh"
tasks=${1:-64} triangles=${2:-11M} troubles=${3:-40}
export XDG_DATA_HOME=$work/home
cd "$work" || exit 2
if ! start_slurm "$work/slurm"; then
  echo "Slurm does not run here; as root: apt-get install slurmctld slurmd slurm-client" >&2
  exit 2
fi
trap 'stop_slurm; rm -rf "$work"' EXIT
RANDOM=1
scene=()
for i in 0 1 2 3; do
  scene+=("$work/$i.ply")
  "$roam" make terrain -o "${scene[i]}" --triangles "$triangles" --size 1500 --seed "$i" \
    --origin "$((i % 2 * 1500)),$((i / 2 * 1500)),0" > /dev/null || exit 2
done
build "$work/whole" --threads 2 > said 2>&1 || { cat said; exit 2; }
grep . said

"$roam" cluster slurm "${scene[@]}" -o "$work/array" --shards "$tasks" --threads 1 --submit || exit 2
running() { squeue --noheader --array --states=running --name=roam-tasks --format=%i; }
declare -A met=()
for ((i = 0; i < troubles;)); do
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
  esac > out 2>&1 && met[$kind]=$((${met[$kind]:-0} + 1)) && i=$((i + 1))
done
slurm_waits 7200 '[[ -z $(squeue --noheader) ]]' || complain "the jobs do not end"
for kind in "${!met[@]}"; do echo "$kind: ${met[$kind]} times"; done

# The merge names the tasks that were killed for good, and the same jobs again end the build.
said=$(cat slurm-*.out)
if [[ ! -e array/CURRENT ]]; then
  missing=$(grep -o 'missing shards: .*, in tasks [0-9,.-]* of' <<< "$said" | tail -1)
  [[ $missing ]] && echo "$missing $tasks" || complain "the merge says nothing: $(tail -n 1 <<< "$said")"
  "$roam" cluster slurm "${scene[@]}" -o "$work/array" --shards "$tasks" --threads 1 --submit || exit 2
  slurm_waits 7200 '[[ -z $(squeue --noheader) ]]' || complain "the jobs do not end the second time"
fi
expect_same "$work/array" "an array of $tasks tasks, $troubles troubles"
expect_whole_or_none "$work/array" "an array"

# Seconds of each step, alone on this machine.
number() { grep -o "\"$1\": [0-9.]*" "$2" | head -1 | cut -d' ' -f2; }
build "$work/timed" --plan "$tasks" --threads 2 --json > plan.json 2> /dev/null
for ((i = 0; i < tasks; ++i)); do
  TIMEFORMAT='%R %U %S'
  { time "$roam" build -o "$work/timed" --shard $i --threads 1 > /dev/null 2>&1; } 2>&1
done > times
"$roam" build -o "$work/timed" --merge --threads 2 --json > merge.json 2> /dev/null
expect_same "$work/timed" "tasks one after the other"
awk -v read="$(number read_s plan.json)" -v plan="$(number plan_s plan.json)" -v balance="$(number balance plan.json)" \
  -v merge="$(number merge_s merge.json)" '
  { cpu = $2 + $3; sum += cpu; wall += $1; if (cpu > most) most = cpu }
  END {
    printf "tasks: %d, processor %.1f s together, %.2f s a task, longest %.2f times the mean (triangles: %s)\n", NR, sum,
      sum / NR, most * NR / sum, balance
    printf "read %.1f s, plan %.1f s, tasks %.1f s one after the other, merge %.1f s; plan and merge: %.1f %%\n", read, plan,
      wall, merge, 100 * (plan + merge) / (read + plan + wall + merge)
  }' times
finish "$tasks tasks"
