#!/usr/bin/env bash
# Whether batch engines build the store that one process builds.
#   cluster.sh SOURCE WORK ROAM slurm      arrays that read and build, a plan and a merge, on two nodes of a real Slurm
#   cluster.sh SOURCE WORK ROAM parallel   shares and tasks by GNU parallel, each twice at once
# Status 77 if the engine cannot run here.
set -euo pipefail
source=$1 work=$2/$4 roam=$3 engine=$4
source "$source/tests/support/slurm.sh"
skip() { echo "skipped: $1"; exit 77; }
rm -rf "$work"
mkdir -p "$work"
work=$(realpath "$work")
cd "$work"
export XDG_DATA_HOME=$work/home
case $engine in
  slurm) start_slurm "$work/slurm" || skip "Slurm does not run here (packages slurmctld, slurmd, slurm-client)" ;;
  parallel) [[ $(parallel --version 2> /dev/null) == GNU* ]] || skip "there is no GNU parallel" ;;
esac

scene=(one.ply two.ply three.ply)
for i in 0 1 2; do
  "$roam" make terrain -o "${scene[i]}" --triangles 850k --seed $i --origin "$((1000 * i)),0,0" > /dev/null
done
"$roam" build "${scene[@]}" -o whole.roam --threads 2 2> /dev/null
case $engine in
  slurm)
    "$roam" cluster slurm "${scene[@]}" -o tasks.roam --shards 4 --threads 1 --memory 256M --submit
    slurm_waits 200 '[[ -z $(squeue --noheader) ]]' || { squeue; exit 1; }
    cat slurm-*.out
    (($(grep -hoE '^share [0-3] of 4 \(Slurm, SLURM_ARRAY_TASK_ID=[0-3]\): parts read: [01],' slurm-*.out |
      sort | uniq | awk '{ sum += $NF; ++shares } END { print shares == 4 && sum == 3 }')))
    grep -q '^Parts read: 0 of 3\.' slurm-*.out
    (($(grep -lE '^task [0-3] of 4 \(Slurm, SLURM_ARRAY_TASK_ID=[0-3]\): shards built: 1,' slurm-*.out | wc -l) == 4))
    ;;
  parallel)
    # The third share is missing, and the first two are read twice at once.
    for run in 1 2; do
      seq 2 | parallel -N0 --jobs 2 "$roam" build "${scene[@]}" -o tasks.roam --plan 3 --shard auto 2> /dev/null &
    done
    wait
    "$roam" build "${scene[@]}" -o tasks.roam --plan 3 2> /dev/null | tee plan
    grep -q '^Parts read: 1 of 3\.' plan
    # Two runs of all tasks, and a fourth job, for which there is no task.
    for run in 1 2; do
      seq 4 | parallel --jobs 2 "$roam" build -o tasks.roam --shard auto --threads 1 > "said$run" 2> /dev/null &
    done
    wait
    cat said1 said2
    (($(grep -c '^task [0-2] of 3 (GNU parallel, PARALLEL_SEQ=[1-3])' said1) == 3))
    grep -q '^nothing to do: .*from 0 to 2 (PARALLEL_SEQ=4)' said2
    "$roam" build -o tasks.roam --merge 2> /dev/null
    # Again, as an engine may.
    [[ $("$roam" build -o tasks.roam --merge) == "nothing to do: tasks.roam is complete"* ]]
    PARALLEL_SEQ=2 "$roam" build -o tasks.roam --shard auto
    ;;
esac
diff -r --exclude=LOCK --exclude=sources.json whole.roam tasks.roam
echo "the same bytes"
