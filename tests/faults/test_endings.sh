#!/usr/bin/env bash
# How the program ends when it is made to: by signals, and where it can start no thread. PROGRAM PRELOAD, the latter
# no_more_threads.so.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/../tools/cli_checks.sh"
preload=$(readlink -f -- "${2:?usage: ${0##*/} PROGRAM PRELOAD}")

# Whatever number of threads can be started, a command is carried out or says that there was none.
check_threads() {
    local allowed command whole=0
    "$strata" render terrain --size 64x36 -N 2 --quiet -o expected.exr
    for command in 'render terrain -o a.exr' 'animate planet --frames 0-1 -o a.png' 'sweep terrain --N 1 --m 1 -o a' \
        'strip --scene terrain --columns none -o a.png' 'explain terrain' 'scenes'; do
        for allowed in 0 1 2 3 4 5 6 7 8 9 10; do
            local words=("$strata")
            read -r -a more <<<"$command"
            words+=("${more[@]}")
            [[ $command == scenes ]] || words+=(--size 64x36)
            [[ $command == scenes || $command == sweep* ]] || words+=(-N 2)
            [[ $command == scenes ]] || words+=(--threads 4)
            output=$(STRATA_TEST_THREADS=$allowed LD_PRELOAD=$preload "${words[@]}" 2>&1)
            status=$?
            if ((status == 0)); then
                whole=$((whole + 1))
                [[ $command != render* ]] || expect_same_file "fewer threads ($allowed) make the same picture" a.exr expected.exr
            else
                expect_match "'$command' with $allowed threads says so" "$status: $output" '1: strata: no thread could be started: *'
            fi
            rm -rf a a.exr a.*.png a.png
            expect "'$command' with $allowed threads leaves nothing hidden" "$(find . -name '.*' ! -name .)" ''
        done
    done
    expect 'with some threads all is done' "$((whole >= 25))" 1
}

# Sets pid; the program listens, and a picture is in the making.
start() { # options of env...
    env "$@" "$strata" render hyperterrain --size 320x180 -N 64 --quiet -o a.exr &
    pid=$!
    await_handler "$pid"
    for ((i = 0; i < 500; ++i)); do
        [[ $(find . -name '.strata*') ]] && break
        sleep 0.01
    done
    sleep 0.2
}

check_hangup() {
    start --default-signal=INT,HUP
    kill -HUP "$pid"
    wait "$pid"
    expect 'SIGHUP ends a render with 129' "$?" 129
    expect 'and leaves what is finished' "$(ls -A)" a.partial.exr
}

check_ignored() {
    start --default-signal=INT --ignore-signal=HUP
    kill -HUP "$pid"
    sleep 0.3
    expect 'under nohup a render goes on' "$(kill -0 "$pid" && echo alive)" alive
    kill -TERM "$pid"
    wait "$pid"
    expect 'and ends with SIGTERM' "$?" 143
}

# TERM from timeout comes twice: to the program and to its group.
check_timeout() {
    timeout 3 "$strata" render hyperterrain --size 320x180 -N 64 --quiet -o a.exr
    expect 'timeout ends a render' "$?" 124
    expect 'as one signal: what is finished is kept' "$(ls -A)" a.partial.exr
}

# So many pixels that writing the partial picture takes a while.
check_second_signal() {
    local signal
    for signal in INT TERM HUP; do
        env --default-signal=INT,HUP "$strata" render hyperterrain --size 16384x16384 -N 1 --quiet -o a.exr -o a.png &
        pid=$!
        await_handler "$pid"
        sleep 1.5
        kill "-$signal" "$pid"
        sleep 0.3
        kill "-$signal" "$pid"
        wait "$pid"
        expect "a second SIG$signal ends with its code" "$?" $((128 + $(kill -l "$signal")))
        expect "a second SIG$signal leaves nothing hidden" "$(ls -A)" ''
    done
    env --default-signal=QUIT "$strata" render hyperterrain --size 16384x16384 -N 1 --quiet -o a.exr &
    pid=$!
    sleep 1.5
    kill -QUIT "$pid"
    wait "$pid"
    expect 'SIGQUIT ends at once, with nothing hidden left' "$? $(ls -A)" '131 '
}

# A film program that never ends by itself.
check_children() {
    mkdir fake
    # shellcheck disable=SC2016 # the variable is the fake program's
    printf '#!/bin/sh\necho $$ >"%s/child"\nexec sleep 600\n' "$PWD" >fake/ffmpeg
    chmod +x fake/ffmpeg
    local signal child
    for signal in TERM HUP; do
        rm -f child
        PATH="$PWD/fake:$PATH" env --default-signal=INT,HUP "$strata" animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o w.mp4 &
        pid=$!
        for ((i = 0; i < 1000; ++i)); do
            [[ -s child ]] && break
            sleep 0.02
        done
        child=$(<child)
        kill "-$signal" "$pid"
        wait "$pid"
        expect "SIG$signal while a film is encoded ends with its code" "$?" $((128 + $(kill -l "$signal")))
        expect "and the film's program ends too" "$(kill -0 "$child" 2>/dev/null && echo alive)" ''
        expect 'nothing hidden is left' "$(find . -name '.*' ! -name .)" ''
    done
}

run_groups check_threads check_hangup check_ignored check_timeout check_second_signal check_children
