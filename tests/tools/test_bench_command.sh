#!/usr/bin/env bash
# strata bench: its table and files, exact counts, comparison with an earlier run, refusals.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--quick --rays 20000)

# What is not a time in a bench.json: all but times, what follows from them, and time shares.
counts() {
    grep -v -E '"(ns_per|cpu_s|wall_s|share|value|of_medians|verdict|note)|^ *[0-9.e-]+,?$' -- "$1"
}

check_run() {
    run bench "${tiny[@]}" --only octaves,reference -o new/report
    expect_match 'a run prints cases, blocks, figures and where the files are' "$status: $output" \
        '0: *case*ns/ray*evals/ray*hyperterrain, 24 octaves*reference*figure*floor*reference ns*Not measured: *peers*wrote    new/report*'
    expect 'the report is four files' "$(cd new/report && echo *)" 'bench.json bench.png bench.svg bench.txt'
    expect_match 'the plot is a PNG' "$(head -c 4 new/report/bench.png | od -An -c)" '*P*N*G*'
    run bench "${tiny[@]}" --only octaves,reference --quiet -o again --repeat 2
    expect 'a quiet run is quiet' "$status: $output" '0: '
    counts new/report/bench.json | grep -v '"rounds"' >a
    counts again/bench.json | grep -v '"rounds"' >b
    expect_same_file 'two runs differ in times only' a b
    local key missing=''
    for key in kind format version machine rounds figures cases curves peers memory id mark rays shadow_rays hits \
        noise_evaluations steps evaluations_per_ray ns_per_ray ns_per_ray_median cpu_s phases floor aim verdict; do
        grep -q "^ *\"$key\": " again/bench.json || missing+=" $key"
    done
    expect 'the JSON holds every key' "$missing" ''
    expect 'rays are samples of the pixels' \
        "$(sed -n 's/^ *"\(pixels\|N\|rays\)": \([0-9]*\),$/\1 \2/p' again/bench.json |
            awk '$1 == "N" { n = $2 } $1 == "pixels" { p = $2 } $1 == "rays" && p { print ($2 == p * n * n); p = 0 }' | sort -u)" 1
}

check_against() {
    run bench "${tiny[@]}" --only octaves --quiet -o before
    run bench "${tiny[@]}" --only octaves,samples --against before/bench.json -o now
    expect_match 'a later run prints ratios' "$status: $output" '0: *now over then*hyperterrain, 4 octaves*geometric mean*'
    expect 'counts have not changed' "$(sed -n 's/^ *"evaluations_per_ray_ratio": //p' now/bench.json | sort -u)" 1.0
    refuses 'other blocks are refused before anything is measured' 2 "*before/bench.json: its 'hyperterrain*another scene or other pixels*" \
        bench --quick --rays 200000 --only octaves --against before/bench.json -o other
    refuses 'other sections are refused' 2 '*before/bench.json: has no case of this run*' \
        bench "${tiny[@]}" --only reference --against before/bench.json -o other
    sed 's/"format": 1/"format": 2/' before/bench.json >newer.json
    refuses 'another format is refused' 2 '*newer.json: is of format 2*' bench "${tiny[@]}" --only octaves --against newer.json
    refuses 'a file that is not there is refused' 2 '*nowhere.json: cannot be read*' bench --quick --against nowhere.json
    echo 'x' >text
    refuses 'a folder is refused' 2 '*--against .: cannot be read: Is a directory*' bench --quick --against .
    refuses 'a file of anything is refused' 2 '*text: is no JSON*' bench --quick --against text
    expect 'nothing was written' "$(echo other*)" 'other*'
}

check_refusals() {
    refuses 'an unknown section gets the nearest' 2 "*--only: 'octave' is no section*did you mean 'octaves'*" bench --only octave
    refuses 'an empty section is refused' 2 "*--only: '' is no section*" bench --only scenes,
    refuses 'a section named twice is refused' 2 "*'scenes' is named twice*" bench --only scenes,scenes
    refuses 'no rounds are refused' 2 '*--repeat 0: allowed*' bench --repeat 0
    refuses 'no rays are refused' 2 '*--rays 0: allowed*' bench --rays 0
    refuses '--whole and --rays exclude each other' 2 '*--whole and --rays*' bench --whole --rays 5
    refuses 'an unknown SIMD target is refused' 2 '*--simd*avx9*' bench --simd avx9
    touch file
    refuses 'a file in the place of the folder is refused' 1 '*-o file*' bench --quick -o file
    expect 'nothing is written when something is refused' "$(echo *)" file
}

check_peers_and_memory() {
    run bench "${tiny[@]}" --only peers,memory --no-files
    expect_match 'peers and memory are measured, or told how to get' "$status: $output" '0: *Peers:*Embree*Memory*1920x1080*MB*'
    expect 'no file is written' "$(echo *)" '*'
}

check_signal() {
    "${interruptible[@]}" "$strata" bench --only scenes --quiet -o stopped 2>said &
    local pid=$!
    await_handler "$pid"
    sleep 0.5
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends a run with 130' "$?" 130
    expect_match 'and says that no file was written' "$(cat said)" '*interrupted after 0 of 3 rounds*'
    expect 'no file is there' "$(echo stopped/*)" 'stopped/*'
}

run_groups check_run check_against check_refusals check_peers_and_memory check_signal
