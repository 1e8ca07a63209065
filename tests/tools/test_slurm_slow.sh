#!/usr/bin/env bash
# A farm on a real Slurm: two nodes that are both this machine. In an array of 8 shards a task is killed, one is requeued
# and a node goes down; the merge makes the file of one process, run after run. PROGRAM [RUNS]. Ends with 77 where Slurm is
# not installed. Its daemons are plain processes, here with a cluster of their own that ends with this script.
set -u

for program in munged slurmctld slurmd sbatch mungekey; do
    command -v $program >/dev/null || { echo "no $program here" && exit 77; }
done
runs=${2:-3}
# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"
daemons=()
export SLURM_CONF=$scratch/slurm.conf

free_port() { # first: the first of three that nothing listens at
    local port=$1
    while ss -Hltn | grep -qE ":($port|$((port + 1))|$((port + 2))) "; do port=$((port + 3)); done
    echo "$port"
}

# Job steps are found by their process tree alone, which needs neither root nor cgroups; a node that is silent for 5 s is
# lost; times between events are a test's.
configure() {
    local host user port
    host=$(hostname -s) user=$(id -un) port=$(free_port $((20000 + RANDOM % 10000)))
    mkdir -p "$scratch"/{munge,state,spool,log}
    chmod 755 "$scratch" "$scratch/munge"
    chmod 700 "$scratch/state"
    cat >"$SLURM_CONF" <<CONFIGURATION
ClusterName=test
SlurmctldHost=$host
SlurmctldPort=$port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$scratch/munge/socket,cred_expire=5
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool/%n
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd-%n.pid
MailProg=/bin/true
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=bf_interval=1,sched_interval=1,batch_sched_delay=0
JobRequeue=1
ReturnToService=2
SlurmdTimeout=5
KillWait=2
AccountingStorageType=accounting_storage/none
NodeName=n[1-2] NodeHostname=$host NodeAddr=$host Port=[$((port + 1))-$((port + 2))] CPUs=2 RealMemory=500 State=UNKNOWN
PartitionName=test Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP
CONFIGURATION
    echo 'CgroupPlugin=cgroup/v1' >"$scratch/cgroup.conf"
}

begin() { # name command...
    "${@:2}" >"$scratch/log/$1" 2>&1 &
    daemons=("$!" "${daemons[@]}")
}

quietly() { "$@" >/dev/null 2>&1; }
all_idle() { [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]]; }

start_cluster() {
    configure
    quietly mungekey -c -k "$scratch/munge/key"
    begin munged munged -F --key-file="$scratch/munge/key" --socket="$scratch/munge/socket" \
        --log-file="$scratch/munge/log" --pid-file="$scratch/munge/pid" --seed-file="$scratch/munge/seed"
    await 'munge answers' 20 quietly munge -S "$scratch/munge/socket" -n
    begin slurmctld slurmctld -D -c -f "$SLURM_CONF"
    await 'the controller answers' 60 quietly scontrol ping
    for node in n1 n2; do begin $node slurmd -D -N $node -f "$SLURM_CONF"; done
    await 'two nodes are idle' 60 all_idle
}

# The youngest first.
stop_cluster() {
    for daemon in "${daemons[@]}"; do
        kill "$daemon" 2>/dev/null
        wait "$daemon" 2>/dev/null
    done
}

# A state of a task, by its number: its words are "running ATTEMPT HOST SINCE".
runs_on() { # task pattern of hosts
    # shellcheck disable=SC2053 # a pattern is meant
    [[ $(cut -d ' ' -f 1,3 "$folder/tasks/$1.state" 2>/dev/null) == "running "$2 ]]
}
renderer_of() { pgrep -f -- "-o parts/$1[.]exr" | head -n 1; } # task
has_renderer() { [[ $(renderer_of "$1") ]]; }
first_running() { # pattern of hosts: sets task
    for task in {1..8}; do
        ! { [[ ! -e $folder/tasks/$task.done ]] && runs_on "$task" "$1" && has_renderer "$task"; } || return 0
    done
    return 1
}
is_merged() { [[ -e $folder/tasks/9.done ]]; }

disturb() {
    local array
    read -r array _ <"$folder/jobs"
    await 'a task runs' 60 first_running '*'
    kill -KILL "$(renderer_of "$task")"
    echo "killed the renderer of task $task" >&2
    sleep 1
    await 'another one runs' 60 first_running n1
    quietly scontrol requeue "${array}_$task"
    echo "requeued task $task" >&2
    await 'one runs on n2' 60 first_running n2
    quietly scontrol update NodeName=n2 State=DOWN Reason=test
    echo "node n2 is down, with task $task" >&2
    sleep 2
    quietly scontrol update NodeName=n2 State=RESUME
}

check_slurm() {
    trap stop_cluster EXIT
    start_cluster
    local words=(hyperterrain --size 640x400 -N 6)
    run render "${words[@]}" --quiet -o whole.exr
    expect 'one process renders the whole' "$status: $output" '0: '
    for ((turn = 1; turn <= runs; ++turn)); do
        rm -rf out.exr out.exr.farm
        run farm submit "${words[@]}" --shards 8 -o out.exr
        expect_match 'the farm is submitted' "$status: $output" '0: *submitted*'
        folder=$PWD/out.exr.farm
        disturb
        await 'the picture is merged' 300 is_merged || { "$strata" farm status out.exr.farm && squeue; } >&2
        run farm status out.exr.farm
        expect_match 'status tells the end' "$status: $output" '0: *done     8 of 8*failed   0*the last done*'
        expect_same_file "run $turn: the picture is that of one process" out.exr whole.exr
        echo "run $turn: $(cat "$folder"/tasks/*.log | grep -c '^attempt') attempts failed" >&2
    done
}

run_groups check_slurm
