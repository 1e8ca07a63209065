#!/usr/bin/env bash
# strata figures: what it writes, what it keeps, what it refuses.
# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

check_refusals() {
    refuses 'a figure that is not there is refused' 2 '*--only 9: allowed*1 to 8*' figures --only 9
    refuses 'a figure 0 is refused' 2 '*--only 0: allowed*' figures --only 1,0
    output=$(TMPDIR=/nonexistent "$strata" figures --only 1 --size small -o untouched --quiet 2>&1)
    expect_match 'a temporary folder that cannot be made is named with what to do' "$?: $output" \
        '1: *cannot make a temporary folder in "/nonexistent": No such file*TMPDIR*'
    rm -rf untouched
    refuses 'a word is no figure' 2 '*--only one: allowed*' figures --only one
    refuses 'an empty number is refused' 2 '*--only*allowed*' figures --only 1,
    refuses 'an unknown size gets the known ones' 2 '*--size huge: allowed: small, paper, large*' figures --size huge
    refuses 'negative threads are refused' 2 '*--threads -1: allowed*' figures --threads -1
    refuses 'a misspelt option gets the nearest name' 2 "*did you mean '--only'*" figures --onyl 1
    echo file >file
    refuses 'a file is no folder' 2 '*-o file*' figures --only 1 -o file
    refuses 'a folder in a file cannot be made' 2 '*-o file/sub*' figures --only 1 -o file/sub
    output=$(PATH=/nowhere "$strata" figures --only 1 -o there 2>&1)
    expect_match 'without gnuplot the package is named' "$?: $output" '1: *gnuplot-nox*'
    expect 'nothing is written when something is refused' "$(echo *)" file
}

check_plots() {
    run figures --only 3,1,2,1 --size small -o 'a folder/sub' --html --no-films
    expect_match 'figures are made in their order, and the page' "$status: $output" \
        '0: made *figure-1.png*made *figure-2.png*made *figure-3.png*made *index.html*'
    cd 'a folder/sub' || return
    expect 'each plot is there as PNG and SVG, with its record' "$(echo *)" "figure-1.json figure-1.png figure-1.svg \
figure-2.json figure-2.png figure-2.svg figure-3-samples.csv figure-3.json figure-3.png figure-3.svg index.html"
    local missing='' key
    for key in figure title caption chosen command size version simd_target shown data comparisons parameters parts; do
        grep -q "\"$key\":" figure-1.json || missing+=" $key"
    done
    expect 'the record is one line with every key' "$(wc -l <figure-1.json)$missing" 1
    # The samples of figure 3 are those that the renderer probes.
    local probed drawn
    probed=$("$strata" probe samples wheel --size 16x16 --pixel 7,7 -N 10 -m 4 --seed 1 --estimator stratified |
        sed 's/{"u":\([^,]*\),"v":\([^,]*\),.*/\1,\2/')
    drawn=$(sed -n 's/^stratified,\(.*\),.*/\1/p' figure-3-samples.csv)
    expect 'the samples drawn are those of the renderer' "$drawn" "$probed"
    run figures --only 1,2,3 --size small -o ../again --quiet --html --no-films
    expect '--quiet prints nothing' "$status: $output" '0: '
    local file
    for file in *; do expect_same_file "made again, $file is the same" "$file" "../again/$file"; done
}

check_pictures() {
    run figures --only 4 --size small -o f
    expect_match 'figure 4 is made' "$status: $output" '0: made *f/figure-4.png*'
    expect 'it consists of a sheet, six panels, six parts and a record' "$(cd f && echo *.png | wc -w) $(cd f && echo *.exr | wc -w) \
$(cd f && echo *.json)" '7 6 figure-4.json'
    run render f/figure-4-checker-box.exr --quiet -o part.exr
    expect_same_file 'a part is rendered again from what it says of itself' f/figure-4-checker-box.exr part.exr
    run figures --only 4 --size small -o f
    expect_match 'a whole figure is kept' "$status: $output" '0: kept *f/figure-4.png*'
    rm f/figure-4-checker-box.exr
    run figures --only 4 --size small -o f --threads 1
    expect_match 'a figure that lost a part is made again' "$status: $output" '0: made *'
    expect_same_file 'its parts do not depend on threads' f/figure-4-checker-box.exr part.exr
    local file
    for file in figure-4.png figure-4-checker-box.exr; do
        truncate -s -9 "f/$file"
        run figures --only 4 --size small -o f
        expect_match 'a figure with a cut file is made again and the file named' "$status: $output" \
            "0: damaged  f/$file: its bytes are not those*made *"
    done
    : >f/figure-4-checker-box.exr
    run figures --only 4 --size small -o f
    expect_match 'and one with an empty file' "$status: $output" '0: damaged  f/figure-4-checker-box.exr: it is empty*made *'
    run figures --only 4 --size small -o f
    expect_match 'then it is whole and kept' "$status: $output" '0: kept *f/figure-4.png*'
    run figures --only 4 --size small -o f --overwrite
    expect_match '--overwrite makes it again' "$status: $output" '0: made *'
}

check_signals() {
    "${interruptible[@]}" "$strata" figures --only 5 --size large -o f --quiet &
    local pid=$!
    await_handler "$pid"
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends with 130' "$?" 130
    expect 'an unfinished figure leaves no record and no picture' "$(echo f/*)" 'f/*'
}

run_groups check_refusals check_plots check_pictures check_signals
