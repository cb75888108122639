#!/usr/bin/env bash
# Whether batch engines build the store that one process builds.
#   cluster.sh SOURCE WORK ROAM slurm      an array of 4 tasks and its merge, on two nodes of a real Slurm
#   cluster.sh SOURCE WORK ROAM parallel   tasks by GNU parallel, each twice at once
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

"$roam" make terrain -o scene.ply --triangles 2600k > /dev/null
"$roam" build scene.ply -o whole.roam --threads 2 2> /dev/null
case $engine in
  slurm)
    "$roam" cluster slurm scene.ply -o tasks.roam --shards 4 --threads 1 --memory 256M --submit
    slurm_waits 200 '[[ -z $(squeue --noheader) ]]' || { squeue; exit 1; }
    cat slurm-*.out
    (($(grep -lE '^task [0-3] of 4 \(Slurm, SLURM_ARRAY_TASK_ID=[0-3]\): shards built: 1,' slurm-*.out | wc -l) == 4))
    ;;
  parallel)
    "$roam" build scene.ply -o tasks.roam --plan 3 2> /dev/null
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
