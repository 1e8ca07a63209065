#!/usr/bin/env bash
# How the program ends when it is made to: by signals, and where it can start no thread. PROGRAM PRELOAD, the latter
# built from the sources beside this.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/../tools/cli_checks.sh"
preload=$(readlink -f -- "${2:?usage: ${0##*/} PROGRAM PRELOAD}")

# Whatever number of threads can be started, the command is carried out or says that there was none.
check_threads() { # least most words...
    local allowed whole=0 words=("$strata" "${@:3}")
    "$strata" render terrain --size 64x36 -N 2 --quiet -o expected.exr
    [[ $3 == scenes ]] || words+=(--size 64x36 --threads 4)
    for ((allowed = $1; allowed <= $2; ++allowed)); do
        output=$(STRATA_TEST_THREADS=$allowed LD_PRELOAD=$preload timeout 60 "${words[@]}" 2>&1)
        status=$?
        if ((status == 0)); then
            whole=$((whole + 1))
            [[ $3 != render ]] || expect_same_file "fewer threads ($allowed) make the same picture" a.exr expected.exr
        else
            expect_match "'${*:3}' with $allowed threads says so" "$status: $output" '1: strata: no thread could be started: *'
        fi
        rm -rf a a.exr a.*.png a.png
        expect "'${*:3}' with $allowed threads leaves nothing hidden" "$(find . -name '.*' ! -name .)" ''
    done
    expect "with some threads '${*:3}' is done" "$((whole >= 1))" 1
}

# Libraries start some before the program begins, whatever the command; beyond 10 there is nothing left to start.
check_threads_render() { check_threads 0 10 render terrain -N 2 -o a.exr; }
check_threads_animate() { check_threads 3 8 animate planet -N 2 --frames 0-1 -o a.png; }
check_threads_sweep() { check_threads 3 8 sweep terrain --N 1 --m 1 -o a; }
check_threads_strip() { check_threads 3 8 strip --scene terrain -N 2 --columns none -o a.png; }
check_threads_explain() { check_threads 3 8 explain terrain -N 2; }
check_threads_scenes() { check_threads 3 5 scenes; }

has_hidden_file() { [[ $(find . -name '.strata*') ]]; }

# Sets pid; the program listens, and a picture is in the making.
start() { # words, with those of env first
    env --default-signal=INT,HUP,QUIT "$@" &
    pid=$!
    await_handler "$pid"
    await 'a picture is begun' 30 has_hidden_file
    sleep 0.2
}

# A minute's work.
long=("$strata" render hyperterrain --size 320x180 -N 64 --quiet --no-journal -o a.exr)

check_hangup() {
    start "${long[@]}"
    kill -HUP "$pid"
    await_end 'a render ends by SIGHUP' "$pid"
    expect 'SIGHUP ends a render with 129' "$code" 129
    expect 'and leaves what is finished' "$(ls -A)" a.partial.exr
}

check_ignored() {
    start --ignore-signal=HUP "${long[@]}"
    kill -HUP "$pid"
    sleep 0.3
    expect 'under nohup a render goes on' "$(kill -0 "$pid" && echo alive)" alive
    kill -TERM "$pid"
    await_end 'and ends by SIGTERM' "$pid"
    expect 'and ends with SIGTERM' "$code" 143
}

# TERM from timeout comes twice: to the program and to its group.
check_timeout() {
    timeout -k 60 5 "${long[@]}"
    expect 'timeout ends a render' "$?" 124
    expect 'as one signal: what is finished is kept' "$(ls -A)" a.partial.exr
}

# So many pixels that writing the partial picture takes seconds, which a second signal does not wait for.
check_second_signal() {
    local signal
    for signal in INT TERM HUP; do
        start "$strata" render hyperterrain --size 4096x4096 -N 1 --threads 1 --quiet --no-journal -o a.exr -o a.png
        kill "-$signal" "$pid"
        sleep 0.3
        kill "-$signal" "$pid"
        await_end "a second SIG$signal ends it" "$pid"
        expect "a second SIG$signal ends with its code" "$code" $((128 + $(kill -l "$signal")))
        expect "a second SIG$signal leaves nothing hidden" "$(ls -A)" ''
    done
    start "$strata" render hyperterrain --size 4096x4096 -N 1 --threads 1 --quiet --no-journal -o a.exr
    kill -QUIT "$pid"
    await_end 'SIGQUIT ends it' "$pid"
    expect 'SIGQUIT ends at once, with nothing hidden left' "$code $(ls -A)" '131 '
}

# A film program that never ends by itself, and writes its number into ./child.
make_endless_ffmpeg() {
    mkdir fake
    # shellcheck disable=SC2016 # the variable is the fake program's
    printf '#!/bin/sh\necho $$ >"%s/child"\nexec sleep 600\n' "$PWD" >fake/ffmpeg
    chmod +x fake/ffmpeg
}

# The signal comes to the program when ffmpeg runs.
check_film_ends() { # when signal words of env...
    rm -f child
    env --default-signal=INT,HUP "${@:3}" PATH="$PWD/fake:$PATH" "$strata" animate wheel --size 16x16 -N 1 --frames 0-1 --quiet \
        -o w.mp4 &
    local pid=$! child=none
    await "a film's program is started" 60 test -s child && child=$(<child)
    kill "-$2" "$pid"
    await_end "SIG$2 $1 ends it" "$pid"
    expect "SIG$2 $1 ends with its code" "$code" $((128 + $(kill -l "$2")))
    # Killed if it is alive.
    expect "SIG$2 $1 ends the film's program too" "$(kill "$child" 2>/dev/null && echo alive)" ''
    expect "SIG$2 $1 leaves nothing hidden" "$(find . -name '.*' ! -name .)" ''
}

check_children() {
    make_endless_ffmpeg
    check_film_ends 'while a film is encoded' TERM
    check_film_ends 'while a film is encoded' HUP
}

# The film's program is there already; that it was started is not yet known to whom the signal comes.
check_starting_children() {
    make_endless_ffmpeg
    check_film_ends 'while ffmpeg is being started' TERM LD_PRELOAD="$preload" STRATA_TEST_SPAWN_PAUSE=60
}

run_groups check_second_signal check_timeout check_hangup check_ignored check_children check_starting_children \
    check_threads_render check_threads_animate check_threads_sweep check_threads_strip check_threads_explain \
    check_threads_scenes
