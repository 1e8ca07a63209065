#!/usr/bin/env bash
# How options, numbers and words are read, whatever the command, and what a terminal is shown.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

check_empty_values() {
    local option
    for option in --crop --threads --tile --tracer --simd --format --aov --stats --passes --target-rmse --time-limit; do
        refuses "an empty $option is refused, not taken for none" 2 "*$option*an empty value*" render "$option" ''
    done
    refuses 'so is an empty size' 2 '*--size : allowed*' render --size ''
    refuses 'an empty output' 2 '*format of ""*' render -o ''
    refuses 'an empty scene' 2 '*an empty value*' render ''
    refuses 'an empty name of a scene' 2 '*an empty value*' scenes ''
    refuses 'empty frames' 2 '*--frames*an empty value*' animate wheel --frames ''
    refuses 'an empty folder' 2 '*--output*an empty value*' converge edge -o ''
}

check_control_characters() {
    local name=$'a\e[31m\a.toml' said
    for said in render explain 'probe field' 'strip --columns none --scene'; do
        # shellcheck disable=SC2086 # words are meant
        run $said "$name"
        expect_match "'$said' shows a name's control characters, and does not send them" "$status: $output" '2: *a\\u001B\[31m\\u0007.toml*'
    done
    run render -o $'a\e.bmp'
    expect_match 'of outputs too' "$status: $output" '2: *a\\u001B.bmp*'
}

check_repeated_options() {
    run render wheel --size 64x64 --size 16x9 -N 9 -N 2 --quiet --quiet --crop 0,0,1,1 --crop 0,0,4,4 --tile 9 --tile 3 \
        --threads 7 --threads 1 --set sampling.m=9 --set sampling.m=2 -o a.png -o b.png --stats x.json --stats y.json
    expect 'of an option given twice the last value counts, but outputs add up' "$status: $output $(echo *)" '0:  a.png b.png y.json'
    "$strata" render wheel --size 16x9 -N 2 -m 2 --crop 0,0,4,4 --quiet -o once.png
    expect_same_file 'and the picture is that of the last values' a.png once.png
    local command
    for command in 'probe bspline -m 3 -m' 'explain --no-pilot --threads 1 --threads' 'stability --only noise --seed 1 --seed' \
        'bench --only subset --rays 1 --rays' 'converge edge --repeats 1 --repeats' 'figures --size small --size' \
        'strip a.png --zoom 2 --zoom' 'animate wheel --frames 0 --frames' 'sweep wheel --N 2 --threads 2 --threads'; do
        # shellcheck disable=SC2086 # words are meant
        refuses "'$command' reads the last value" 2 '*nonsense*allowed*' $command nonsense
    done
}

check_typed_numbers() {
    run render hills --size +16x9. -N 2e0 --threads +1 --tile 1e1 --crop 0,0,+8,.4e1 --set camera.fov_deg=.5e2 \
        --set 'camera.position=[0., +.5e1, 1e1]' --set title=Größe --target-rmse +.5 --time-limit .5e1m --quiet -o a.png
    expect 'numbers may be written as people do' "$status: $output" '0: '
    expect 'and text without quotes' "$(grep -ao 'title = \"[^\"]*\"' a.png)" 'title = "Größe"'
    expect 'on standard input too' "$(echo '+.5e0' | "$strata" probe bspline -m 1)" "$(echo 0.5 | "$strata" probe bspline -m 1)"
}

check_progress() {
    command -v script >/dev/null || return
    local term columns said
    for term in dumb ''; do
        said=$(TERM=$term script -qec "'$strata' render hills --size 400x300 -N 4 -o t.png" /dev/null </dev/null)
        expect "with TERM='$term' no code reaches the terminal" "$(grep -c $'\033' <<<"$said")" 0
    done
    for columns in 10 30; do
        said=$(TERM=xterm script -qec "stty cols $columns; '$strata' render hills --size 400x300 -N 6 -o t.png" /dev/null </dev/null)
        expect "a line of progress is cut to $columns columns" "$(grep -o $'\r\033\[K[^\r]*%[^\r]*' <<<"$said" |
            tr -d '\r' | awk -v most="$columns" '{ if (length($0) - 3 >= most) ++long } END { print (NR > 0) " " long + 0 }')" '1 0'
    done
}

run_groups check_empty_values check_control_characters check_repeated_options check_typed_numbers check_progress
