# shellcheck shell=bash
# How the program's command line is tested; sourced by the scripts beside it with the program as argument. Starting the
# program takes longer than what it does here, so groups of checks run at once, each in a folder of its own.

strata=$(readlink -f -- "${1:?usage: ${0##*/} PROGRAM}")
scratch=$(mktemp -d) || exit 1
trap 'rm -rf -- "$scratch"' EXIT
results=$scratch/results

expect() { # sentence actual expected
    if [[ $2 == "$3" ]]; then
        echo passed >>"$results"
    else
        printf 'FAILED: %s\n  expected: %s\n  got:      %s\n' "$1" "$3" "${2:0:400}" | tee -a "$results"
    fi
}

expect_match() { # sentence actual pattern
    # shellcheck disable=SC2053 # a pattern is meant
    if [[ $2 == $3 ]]; then expect "$1" yes yes; else expect "$1" "$2" "$3"; fi
}

expect_same_file() { # sentence file file
    if cmp -s -- "$2" "$3"; then expect "$1" same same; else expect "$1" "$(cmp -- "$2" "$3" 2>&1)" same; fi
}

run() { # arguments...: sets output (of both streams) and status
    output=$("$strata" "$@" 2>&1 </dev/null)
    status=$?
}

# Refused before anything is rendered: the exit code, words of the message, and nothing written.
refuses() { # sentence status pattern arguments...
    local sentence=$1 expected=$2 pattern=$3
    shift 3
    run "$@"
    expect_match "$sentence" "$status: $output" "$expected: $pattern"
}

# Before a program that is started in the background: there a script's programs ignore SIGINT for good.
# shellcheck disable=SC2034 # used by the scripts that source this
interruptible=(env --default-signal=INT --default-signal=QUIT)

# Until a command succeeds; a failed check when it does not in time.
await() { # sentence seconds command...
    local end=$((SECONDS + $2))
    until "${@:3}"; do
        if ((SECONDS > end)); then
            expect "$1, within $2 s" no yes
            return 1
        fi
        sleep 0.02
    done
}

# A script's own background job; sets code. One that does not end in time is a failed check, and killed.
await_end() { # sentence pid
    await "$1" 60 is_over "$2" || kill -KILL "$2"
    wait "$2"
    # shellcheck disable=SC2034 # used by the scripts that source this
    code=$?
}

is_over() { ! kill -0 "$1" 2>/dev/null; } # pid

catches_interrupts() { [[ $(sed -n 's/^SigCgt:.*\(.\)$/\1/p' "/proc/$1/status" 2>/dev/null) == [2367abefABEF] ]]; } # pid

# Until the program catches SIGINT.
await_handler() { await 'the program listens to SIGINT' 30 catches_interrupts "$1"; } # pid

# Runs each group, a function, in a folder named like it, and sums up: the script's last command.
run_groups() { # function...
    local group passed failed
    for group in "$@"; do
        (mkdir "$scratch/$group" && cd "$scratch/$group" && "$group") &
        while (($(jobs -rp | wc -l) >= $(nproc))); do wait -n; done
    done
    wait
    passed=$(grep -c '^passed' "$results") failed=$(grep -c '^FAILED' "$results")
    echo "$passed passed, $failed failed"
    ((failed == 0 && passed > 0))
}
