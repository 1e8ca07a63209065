#!/usr/bin/env bash
# What `strata render` promises of pictures in passes, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 48x27 -N 2 --quiet)

field() { sed -n "s/ *\"$2\": \(.*[^,]\),\{0,1\}$/\1/p" "$1"; }

check_refusals() {
    refuses 'a negative target is refused' 2 '*--target-rmse -1: allowed: a linear radiance*' render --target-rmse -1
    refuses 'a target of NaN is refused' 2 '*--target-rmse nan: allowed*' render --target-rmse nan
    refuses 'a time without a known unit is refused' 2 '*--time-limit 3d: allowed*2m or 1.5h*' render --time-limit 3d
    refuses 'a time of 0 is refused' 2 '*--time-limit 0s: allowed*' render --time-limit 0s
    refuses 'an infinite time is refused' 2 '*--time-limit inf: allowed*' render --time-limit inf
    refuses 'no passes are refused' 2 '*--passes 0: allowed: a whole number, 1 to 1000000*' render --passes 0
    local estimator
    for estimator in none super uniform; do
        refuses "passes of $estimator are refused with those that have any" 2 "*'$estimator' are all alike*stratified*" \
            render --estimator "$estimator" --passes 2
    done
    refuses 'a target of super is refused' 2 '*--target-rmse: passes*' render --estimator super --target-rmse 0.1
    run render hills --estimator super --passes 1 "${tiny[@]}" -o one.png
    expect 'one pass is for every estimator' "$status: $output" '0: '
}

check_same_bits() {
    "$strata" render edge "${tiny[@]}" -o plain.exr
    "$strata" render edge "${tiny[@]}" -o one.exr --passes 1
    expect_same_file '--passes 1 is the plain render, file and all' one.exr plain.exr
    "$strata" render edge "${tiny[@]}" --target-rmse 0.02 --time-limit 1h --stats target.json -o target.exr
    local passes
    passes=$(field target.json passes)
    expect_match 'a target says what it reached' "$(field target.json stopped_by) $passes" '"target-rmse" [1-9]*'
    "$strata" render edge "${tiny[@]}" --passes "$passes" --threads 1 --tile 5 -o passes.exr
    expect_same_file '--passes of what a target took is the same file' passes.exr target.exr
    "$strata" render target.exr --quiet -o again.exr
    expect_same_file 'a picture of passes rendered again is the same file' again.exr target.exr
    "$strata" render edge "${tiny[@]}" --time-limit 0.01s --stats time.json -o time.exr
    expect 'a time limit stops by time' "$(field time.json stopped_by)" '"time-limit"'
    "$strata" render edge "${tiny[@]}" --passes "$(field time.json passes)" -o passes.exr
    expect_same_file '--passes of what fitted a time is the same file' passes.exr time.exr
    run render target.exr --estimator none --quiet -o aliased.exr
    expect 'another estimator may drop the recorded passes' "$status: $output" '0: '
    run render edge --size 48x27 -N 2 --passes 6 --target-rmse 0.000001 -o bounded.exr
    expect_match 'a target that its passes do not reach is told' "$status: $output" '0: *passes   6, sampling error *not reached in these passes*'
}

check_interruption() {
    echo earlier >a.exr
    "${interruptible[@]}" "$strata" render edge --size 64x36 -N 8 --passes 1000000 --quiet --no-journal -o a.exr --stats a.json &
    local pid=$!
    await_handler "$pid"
    sleep 1.5
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends a render in passes with 130' "$?" 130
    expect 'an earlier picture stays' "$(cat a.exr)" earlier
    expect 'the end is told as an interruption' "$(field a.json stopped_by)" '"interrupted"'
    "$strata" render edge --size 64x36 -N 8 --passes "$(field a.json passes)" --quiet -o whole.exr
    "$strata" render a.partial.exr --quiet -o again.exr
    expect_same_file 'an interrupted picture is the mean of its whole passes' again.exr whole.exr
}

run_groups check_refusals check_same_bits check_interruption
