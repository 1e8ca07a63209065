#!/usr/bin/env bash
# strata stability: the fast subset passes, its tables are there and alike, wrong command lines are refused.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

check_fast_subset() {
    run stability --fast -o report/new --json rows.json
    expect_match 'the fast subset passes' "$status: $output" '0: bspline*motion*checks, 0 failed*wrote report/new/stability.md*'
    expect_same_file '--json writes the same table' report/new/stability.json rows.json
    local key missing=''
    for key in group case kind measured bound unit pass detail; do
        grep -q "^      \"$key\": " rows.json || missing+=" $key"
    done
    expect 'rows hold every key' "$missing" ''
    local group
    for group in bspline noise tracing shadow invariance sums motion; do
        expect "the Markdown has group $group" "$(grep -c "^## $group\$" report/new/stability.md)" 1
    done
    # A ray that the table names is replayed with as many steps as it says.
    local replayed
    replayed=$(grep -A6 '"terrain 1920x1080: most steps of a pixel"' rows.json | sed -n 's/.*; strata \(probe ray .*\)".*/\1/p')
    # shellcheck disable=SC2086 # words are meant
    run $replayed
    expect_match 'the worst pixel is replayed' "$status: $output" \
        "0: *\"steps\":$(grep -A2 '"terrain 1920x1080: most steps of a pixel"' rows.json | sed -n 's/.*"measured": \([0-9]*\).*/\1/p'),*"
}

check_equal_runs() {
    run stability --fast --only sums,motion --threads 1 --json a.json --quiet
    expect '--quiet prints nothing when all pass' "$status: $output" '0: '
    run stability --fast --only sums,motion --threads 2 --json b.json --quiet
    expect_same_file 'equal runs are equal files, whatever the threads' a.json b.json
    run stability --fast --only sums,motion --seed 2 --json c.json --quiet
    expect 'another seed passes' "$status" 0
    expect_match 'another seed has other inputs' "$(cmp a.json c.json)" '*differ*'
}

check_refusals() {
    refuses 'an unknown group gets the nearest' 2 "*--only: 'nois'*did you mean 'noise'*" stability --only nois
    refuses 'an empty group is refused' 2 "*--only: ''*bspline*" stability --only noise,,sums
    refuses 'a seed of junk is refused' 2 '*--seed -1: allowed*' stability --seed -1
    refuses 'negative threads are refused' 2 '*--threads -1: allowed*' stability --threads -1
    touch file
    refuses 'a file is no folder' 1 '*"file"*' stability --fast -o file
    refuses 'a missing folder of --json is named first' 1 '*nowhere*' stability --json nowhere/a.json
    expect 'nothing is written when something is refused' "$(echo *)" file
}

run_groups check_fast_subset check_equal_runs check_refusals
