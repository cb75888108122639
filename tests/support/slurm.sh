# A cluster of Slurm with two nodes on this machine, for one user and without Munge. To be sourced.

# start_slurm FOLDER: the daemons, which end with the shell. Fails if they cannot run here.
start_slurm() {
  local host base node
  slurm_folder=$1
  command -v slurmctld slurmd sbatch squeue > /dev/null || return 1
  host=$(hostname -s)
  base=$((20000 + RANDOM % 30000))
  mkdir -p "$slurm_folder/state"
  export SLURM_CONF=$slurm_folder/slurm.conf
  cat > "$SLURM_CONF" << END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$base
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
MailProg=/bin/true
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
SlurmdTimeout=10
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool-%n
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd-%n.pid
SlurmctldLogFile=$slurm_folder/slurmctld.log
SlurmdLogFile=$slurm_folder/slurmd-%n.log
NodeName=one NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 1)) CPUs=2 RealMemory=4000
NodeName=two NodeHostname=$host NodeAddr=127.0.0.1 Port=$((base + 2)) CPUs=2 RealMemory=4000
PartitionName=all Nodes=one,two Default=YES State=UP
END
  declare -gA slurm_daemons=()
  trap stop_slurm EXIT
  slurmctld -D -c > "$slurm_folder/out" 2>&1 < /dev/null &
  slurm_daemons[controller]=$!
  for node in one two; do start_node "$node"; done
  slurm_waits 30 '(($(sinfo --noheader --states=idle --format=%D) == 2))'
}

# start_node NAME
start_node() {
  slurmd -D -N "$1" > "$slurm_folder/out-$1" 2>&1 < /dev/null &
  slurm_daemons[$1]=$!
}

# stop_node NAME: as if its power failed.
stop_node() {
  local process
  kill -KILL "${slurm_daemons[$1]}"
  wait "${slurm_daemons[$1]}" 2> /dev/null || true
  unset "slurm_daemons[$1]"
  for process in $(processes_of "$1"); do kill -KILL "$process" 2> /dev/null || true; done
}

# processes_of NODE: the jobs there, and the processes that watch them.
processes_of() {
  local process said
  for process in $(pgrep -u "$(id -u)" '^(slurmstepd|slurm_script|roam|roam-reader)$'); do
    said=$'\n'$({ tr '\0' '\n' < "/proc/$process/environ"; } 2> /dev/null)$'\n' || continue
    [[ $said != *$'\n'"SLURM_CONF=$SLURM_CONF"$'\n'* || $said != *$'\n'"SLURMD_NODENAME=$1"$'\n'* ]] || echo "$process"
  done
}

# slurm_waits SECONDS CONDITION: until the condition, a command of bash, holds.
slurm_waits() {
  local end=$((SECONDS + $1))
  until eval "$2" 2> /dev/null; do
    ((SECONDS < end)) || return 1
    sleep 0.2
  done
}

stop_slurm() {
  scancel --user="$(id -un)" > /dev/null 2>&1 || true
  slurm_waits 5 '[[ -z $(squeue --noheader) ]]' || true
  kill "${slurm_daemons[@]}" 2> /dev/null || true
  wait 2> /dev/null || true
}
