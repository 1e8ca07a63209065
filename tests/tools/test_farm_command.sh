#!/usr/bin/env bash
# A picture that a farm makes is the very file of one process, whatever happened to the tasks. Slurm is played by
# programs of its names that run all tasks at once; GNU Parallel is itself.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

scene=(hyperterrain --size 200x170 -N 2 --set surface.gain=0.45)

# sbatch runs what it is given, and again what asks for it: as Slurm does, scontrol ends its caller. Before that the
# script `at_requeue` is run, if the test has one.
play_slurm() {
    mkdir -p bin
    cat >bin/sbatch <<'FAKE'
#!/usr/bin/env bash
for word in "$@"; do
    case $word in
    --array=*) tasks=$(seq "${word#*=1-}") ;;
    --dependency=*) depends=1 ;;
    --chdir=*) cd -- "${word#*=}" || exit ;;
    esac
done
echo "$*" >>"$FAKE_SLURM/calls"
echo "${depends:+42}${tasks:+41;here}"
[[ ! ${depends-} || ! -e $FAKE_SLURM/failed ]] || exit 0
exec 2>/dev/null # the shell's own words about what is killed
for task in ${tasks:-0}; do
    export SLURM_RESTART_COUNT=0 SLURM_ARRAY_TASK_ID=$task SLURM_JOB_ID=41$task
    until sh -c "${@: -1}" >/dev/null 2>&1; do
        rm "$FAKE_SLURM/requeued" 2>/dev/null || { touch "$FAKE_SLURM/failed" && break; }
        ((++SLURM_RESTART_COUNT))
    done
done
FAKE
    cat >bin/scontrol <<'FAKE'
#!/usr/bin/env bash
touch "$FAKE_SLURM/requeued"
[[ ! -e $FAKE_SLURM/at_requeue ]] || . "$FAKE_SLURM/at_requeue"
kill -KILL "$PPID"
FAKE
    cat >bin/squeue <<'FAKE'
#!/bin/sh
cat "$FAKE_SLURM/queue"
FAKE
    cat >bin/scancel <<'FAKE'
#!/bin/sh
echo "scancel $*" >>"$FAKE_SLURM/calls"
FAKE
    chmod +x bin/*
    export FAKE_SLURM=$PWD PATH=$PWD/bin:$PATH
    touch queue
}

make_whole() {
    run render "${scene[@]}" --quiet -o whole.exr
    expect 'the whole is rendered' "$status: $output" '0: '
}

expect_whole() { # sentence
    expect_same_file "$1: the picture is that of one process" out.exr whole.exr
    run farm status out.exr.farm
    expect_match "$1: the status says so" "$status: $output" '0: *done     3 of 3*failed   0*the last done*'
}

submit() { run farm submit "${scene[@]}" --shards 3 -o out.exr "$@"; }

check_slurm() {
    play_slurm
    make_whole
    submit --sbatch=--partition=long
    expect_match 'a picture is submitted' "$status: $output" "0: planned *3 tasks*submitted as Slurm's jobs 41 42*"
    expect_match 'with options of its own, and what depends on it' "$(<calls)" \
        '*--partition=long*--array=1-3*--partition=long*--dependency=afterok:41*'
    expect_whole 'by Slurm'
    submit
    expect_match 'a folder is not planned over' "$status: $output" '2: *is there already*start goes on*'
}

check_failing() {
    play_slurm
    make_whole
    submit --plan
    mkdir -p out.exr.farm/parts/2.exr/hindrance
    echo '((SLURM_RESTART_COUNT < 2)) || rm -r parts/2.exr' >at_requeue
    out.exr.farm/start >/dev/null
    expect_whole 'begun anew after failures'
    expect 'after three attempts that failed' "$(grep -c '^attempt' out.exr.farm/tasks/2.log)" 3

    rm -r out.exr.farm at_requeue
    submit --plan
    mkdir -p out.exr.farm/parts/2.exr/hindrance
    out.exr.farm/start >/dev/null
    expect 'what fails is tried four times' "$(grep -c '^attempt' out.exr.farm/tasks/2.log)" 4
    run farm status out.exr.farm
    expect_match 'and is told with its reason and its log' "$status: $output" \
        '1: *done     2 of 3*failed   1*2, attempt 4 on *: *parts/2.exr*tasks/2.log*the last waiting*'
    rm -r out.exr.farm/parts/2.exr failed
    out.exr.farm/start >/dev/null
    expect_whole 'gone on with when what hindered it is away'

    rm -r out.exr.farm
    submit --plan
    sed -i 's/^./x/' out.exr.farm/program.sha256
    out.exr.farm/start >/dev/null
    run farm status out.exr.farm
    expect_match 'another build of the program does not do the tasks' "$output" '*failed   3*not the build*'
}

check_status() {
    play_slurm
    submit --plan
    cd out.exr.farm || return
    printf '41 42\n' >'jobs'
    echo "running 1 n1 $(($(date +%s) - 100))" >tasks/1.state
    echo '41 1 RUNNING 41 2 PENDING 41 3 PENDING 42 N/A PENDING 7 2 RUNNING' | xargs -n 3 >../queue
    run farm status .
    expect_match 'what Slurm has is told' "$status: $output" '0: *running  1: 1 on n1 for 1 min*waiting  2*failed   0*'
    echo '20000 n2' >tasks/2.done
    run farm status .
    expect_match 'the end is told from what is done' "$output" '*done     1*left     some 20 s, until *'
    sed -i 1d ../queue
    run farm status .
    expect_match 'what Slurm has lost has failed' "$status: $output" '1: *failed   1*1, attempt 1 on n1: it ended without a word*'
    echo 'exit 1' >../bin/squeue
    run farm status .
    expect_match 'without an answer of Slurm a sign of life counts' "$status: $output" '0: *running  1: 1 on n1*'
    touch -d '-5 minutes' tasks/1.state
    run farm status .
    expect_match 'and its absence' "$status: $output" '1: *no sign of life for 5 min*tasks/1.log*'
    run farm cancel .
    expect_match 'Slurm is told to cancel' "$(tail -n 1 ../calls)" 'scancel 41 42'
    run farm status ..
    expect_match 'another folder is none' "$status: $output" '2: *it is no folder of*'
}

check_parallel() {
    make_whole
    submit --engine parallel --hosts : --plan
    # The first attempt of a task is killed, and another process holds the journal of the third.
    sed -i "2s|^|bash -c 'mkdir tried \&\& kill -KILL \$\$; exec \"\$@\"' _ |" out.exr.farm/commands
    touch out.exr.farm/parts/3.exr.journal
    flock out.exr.farm/parts/3.exr.journal out.exr.farm/start >out 2>&1
    expect_whole 'by GNU Parallel'
    expect_match 'a task that was killed is begun anew' "$(<out.exr.farm/tasks/2.log)" '*killed by SIGKILL*'
    expect_match 'a journal in use is done without' "$(<out.exr.farm/tasks/3.log)" '*another process*'
    expect 'nothing else is left' "$(cd out.exr.farm/parts && echo .[!.]* *)" '.[!.]* 1.exr 2.exr 3.exr 3.exr.journal'
    rm out.exr out.exr.farm/tasks/{3,4}.done
    out.exr.farm/start >out 2>&1
    expect_whole 'gone on with'
}

check_cancel() {
    submit --engine parallel --plan
    sed -i "s|.*|sleep 60|" out.exr.farm/commands
    out.exr.farm/start >out 2>&1 &
    local pid=$!
    await 'a task runs' 60 test -s out.exr.farm/tasks/1.state
    run farm cancel out.exr.farm
    await_end 'a farm that is cancelled ends' $pid
    expect_match 'not well' "$code" '[1-9]*'
    run farm status out.exr.farm
    expect_match 'and says so' "$output" '*waiting  3, cancelled*failed   0*'
}

check_frames() {
    local words=(flyover --size 64x36 -N 1 --frames 3-5)
    run animate "${words[@]}" --quiet -o 'whole.####.exr'
    run farm submit "${words[@]}" --engine parallel -o 'out.####.exr' --folder 'a farm'
    expect_match 'frames are made' "$status: $output" "0: planned *3 tasks*status '*a farm'*"
    for frame in 3 4 5; do expect_same_file "frame $frame is that of animate" out.000$frame.exr whole.000$frame.exr; done
}

check_refusals() {
    refuses 'an unknown key' 2 '*surface.gian*' farm submit terrain --set surface.gian=1 -o a.exr
    refuses 'no output' 2 '*--output*' farm submit terrain
    refuses 'a picture that merge does not write' 2 '*-o *a.png: allowed with --shard: .exr*' farm submit terrain -o a.png
    refuses 'an unknown engine' 2 '*--engine cloud: allowed: slurm, parallel*' farm submit terrain -o a.exr --engine cloud
    refuses 'more shards than blocks' 2 '*has 4 blocks*' farm submit terrain --size 128x128 --shards 5 -o a.exr
    refuses 'shards of frames' 2 '*--shards: allowed without --frames*' farm submit flyover --frames 0-1 --shards 2 -o a.exr
    refuses 'a crop of frames' 2 '*--frames: allowed without --crop*' farm submit flyover --frames 0-1 --crop 0,0,9,9 -o a.exr
    refuses 'an unknown SIMD target' 2 '*--simd mmx: allowed*' farm submit terrain --simd mmx -o a.exr
    expect 'what is refused leaves nothing' "$(ls -A)" ''
}

run_groups check_slurm check_failing check_status check_parallel check_cancel check_frames check_refusals
