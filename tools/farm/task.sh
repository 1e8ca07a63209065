#!/usr/bin/env bash
# Does one task of the farm whose folder this is in: task.sh K, or task.sh in an array of Slurm. Line K of `commands` is
# what it does. A task may run any number of times, on several machines at once: all attempts make the same bits, write
# them beside their place and rename them there. In tasks/ there are of task K:
#
#   K.log    what all attempts said
#   K.state  "running ATTEMPT HOST SINCE", its time of change a sign of life; or "failed ATTEMPT HOST REASON"
#   K.done   "MILLISECONDS HOST": what was made is on the disk
set -u
cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" || exit
task=${1:-${SLURM_ARRAY_TASK_ID:?usage: task.sh K}}
attempt=$((${SLURM_RESTART_COUNT:-0} + 1))
most_attempts=4
sign_of_life_s=5
host=$(uname -n)
host=${SLURMD_NODENAME:-$host}
log=tasks/$task.log

# Whole or not at all, whoever else writes it.
put() { # file words...
    local beside=$1.$host.$$
    printf '%s\n' "${*:2}" >"$beside" && mv -f -- "$beside" "$1" && return
    rm -f -- "$beside"
    return 1
}

# Slurm repeats by itself what a lost node did, but not what failed. The sleep is ended by the requeue.
fail() { # reason
    local reason=$1
    [[ ! -e cancelled ]] || reason=cancelled
    printf 'attempt %d on %s: %s\n' $attempt "$host" "$reason" >>"$log"
    [[ -e tasks/$task.done ]] || put "tasks/$task.state" failed $attempt "$host" "$reason"
    if [[ ${SLURM_JOB_ID-} && ! -e cancelled ]] && ((attempt < most_attempts)); then
        scontrol requeue "$SLURM_JOB_ID" && sleep 60
    fi
    exit 1
}

milliseconds() {
    local now=${EPOCHREALTIME/[.,]/}
    echo $((now / 1000))
}

# Sets code. Signals go on to the program, which keeps what is finished in its journal.
work() { # words...
    local child sleeper
    "$@" >>"$log" 2>&1 </dev/null &
    child=$!
    trap 'kill -TERM "$child" 2>/dev/null' TERM INT HUP
    while kill -0 "$child" 2>/dev/null; do
        [[ ! -e cancelled ]] || kill -TERM "$child"
        touch -c "tasks/$task.state"
        sleep $sign_of_life_s &
        sleeper=$!
        wait -n "$child" "$sleeper"
        kill "$sleeper" 2>/dev/null
    done 2>/dev/null
    wait "$child" 2>/dev/null
    code=$?
}

reason() {
    local last
    ((code <= 128)) || {
        echo "killed by SIG$(kill -l $((code - 128)))"
        return
    }
    last=$(tail -n 1 "$log" 2>/dev/null)
    echo "${last:-exit code $code}"
}

[[ ! -e tasks/$task.done ]] || exit 0
[[ ! -e cancelled ]] || fail 'cancelled'
((attempt <= most_attempts)) || fail "given up after $most_attempts attempts"
line=$(sed -n "${task}p" commands)
[[ $line ]] || fail "no task of this number"
put "tasks/$task.state" running $attempt "$host" "$(date +%s)"
sha256sum --check --status program.sha256 2>/dev/null || fail "the program is not here, or is not the build that this was planned for"
declare -a words
eval "words=($line)"
before=$(stat -c %s "$log" 2>/dev/null || echo 0)
begun=$(milliseconds)
work "${words[@]}"
# A journal may be held by an attempt on a node that was lost, or be beyond reading.
if ((code == 2)) && tail -c +$((before + 1)) "$log" | grep -qE -e '--no-journal|--restart'; then
    work "${words[@]}" --no-journal
fi
((code == 0)) || fail "$(reason)"
# What is called done stays so when the power fails.
for ((i = 0; i < ${#words[@]}; ++i)); do
    [[ ${words[i]} == -o && -f ${words[i + 1]} ]] || continue
    sync -- "${words[i + 1]}" "$(dirname -- "${words[i + 1]}")" || fail "cannot be written: ${words[i + 1]}"
done
put "tasks/$task.done" $(($(milliseconds) - begun)) "$host" || fail 'tasks/ cannot be written'
