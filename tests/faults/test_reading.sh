#!/usr/bin/env bash
# What is said when reading a file fails: the n-th read of every n, so that no part of a file passes for the whole.
# PROGRAM PRELOAD, the latter built from the sources beside this; it counts reads of what has "strata-" in its name.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/../tools/cli_checks.sh"
preload=$(readlink -f -- "${2:?usage: ${0##*/} PROGRAM PRELOAD}")

# Sets output, status and failed, the path whose reading failed, if the command came to it.
run_with_fault() { # n words...
    rm -f log
    output=$(STRATA_TEST_FAULT=read:$1:EIO STRATA_TEST_FAULT_LOG=$PWD/log LD_PRELOAD=$preload timeout 60 \
        "$strata" "${@:2}" 2>&1 </dev/null)
    status=$?
    failed=$(sed -n 's/^read [0-9]* failed //p' log)
}

# However far the checksum has come, it is not damage that is told.
check_picture() {
    local n told=0
    "$strata" render wheel --size 40x40 -N 1 --quiet -o strata-a.exr
    for ((n = 1; n <= 30; ++n)); do
        run_with_fault "$n" strip strata-a.exr --quiet -o b.png
        [[ $failed ]] || break
        expect_match "strip with read $n failing" "$status: $output" \
            '2: strata: cannot read "strata-a.exr": *'
        expect "strip with read $n failing does not tell of damage" "${output//damaged/DAMAGED}" "$output"
        [[ $output != *': Input/output error'* ]] || told=$((told + 1))
        expect "strip with read $n failing writes nothing" "$(ls)" $'log\nstrata-a.exr'
    done
    # What fails inside of libraries is told in their words.
    expect 'the reason of most is told' "$((told >= 3))" 1
    expect 'a picture without faults is read' "$status: $output" '0: '
}

# A record holds no digest of a part; what cannot be read for comparison is made again, and the reason is told.
check_record() {
    local n made=0 again=0 figures=(figures --only 6 --size small --quiet -o strata-f)
    "$strata" "${figures[@]}"
    mv strata-f whole
    for ((n = 1; n <= 60; ++n)); do
        rm -rf strata-f
        run_with_fault "$n" "${figures[@]}"
        [[ $failed ]] || break
        [[ $failed == *figure-6.png ]] || continue
        made=$((made + 1))
        expect_match "a record with read $n failing" "$status: $output" \
            '1: strata: cannot read "strata-f/figure-6.png": Input/output error*'
        expect "no record with read $n failing" "$(find strata-f -name '*.json')" ''
    done
    expect 'a record is made of what is read' "$((made >= 1))" 1
    for ((n = 1; n <= 60; ++n)); do
        rm -rf strata-f && cp -r whole strata-f
        run_with_fault "$n" figures --only 6 --size small -o strata-f
        [[ $failed ]] || break
        [[ $failed == *figure-6.png ]] || continue
        again=$((again + 1))
        expect_match "comparing with read $n failing" "$output" \
            '*damaged  strata-f/figure-6.png: Input/output error; it is made again*'
        expect_same_file "comparing with read $n failing makes the same" strata-f/figure-6.png whole/figure-6.png
    done
    expect 'a figure is compared by what is read' "$((again >= 1))" 1
}

run_groups check_picture check_record
