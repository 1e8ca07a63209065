#!/usr/bin/env bash
# What `strata converge` promises on its command line, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 12x10 --N "1,2,4" --m 4 --estimators "stratified,random,shared,uniform" --seeds 3 --repeats 1)

check_refusals() {
    refuses 'no scene is refused' 2 '*SCENE is required*' converge
    refuses 'an unknown image function gets the nearest name' 2 "*did you mean 'edge'*" converge egde
    refuses 'an unknown estimator gets the nearest name' 2 "*'sobl' is no estimator, allowed*did you mean 'sobol'*" \
        converge edge --estimators stratified,sobl
    refuses 'an unknown tracer gets those there are' 2 '*exact: allowed: fast, reference*' converge terrain --tracers exact
    refuses 'a pattern has no tracer but the default' 2 "*'edge' has no surface to trace*" converge edge --tracers reference
    refuses 'N = 0 is refused' 2 '*--N 0: allowed: a whole number, 1 to 64*' converge edge --N 0,1
    refuses 'an N that is no number is refused' 2 '*--N x: allowed*' converge edge --N 1,x
    refuses 'an empty word in a list is refused' 2 '*--m 1,,4: allowed: a list*' converge edge --m 1,,4
    refuses 'm = 101 is refused' 2 '*--m 101: allowed*1 to 100*' converge edge --m 101
    refuses 'no seeds are refused' 2 '*--seeds 0: allowed*' converge edge --seeds 0
    refuses 'a budget without sense is refused' 2 '*--budget soon: allowed*5*' converge edge --budget soon
    refuses 'a scene key out of range is refused' 2 '*ramp.rise: out of range*' converge ramp --set ramp.rise=1e9
    echo file >taken
    refuses 'a file in the place of the folder is refused' 1 '*taken*' converge edge "${tiny[@]}" -o taken
    expect 'the file stays' "$(cat taken)" file
    refuses 'a folder that cannot be made is refused' 1 '*/proc/nowhere*' converge edge "${tiny[@]}" -o /proc/nowhere
    refuses 'a budget too short for anything says what it takes' 2 '*--budget: too short*' \
        converge terrain --N 64 --budget 5s --quiet -o short
    expect 'nothing but the folder was made' "$(find short -type f)" ''
}

# The columns that are not times.
untimed() { awk -F, 'NR==1{for(i=1;i<=NF;i++)if($i!~/seconds/)keep[i]=1}{for(i=1;i<=NF;i++)if(keep[i])printf "%s,",$i;print ""}' "$1"; }

check_report() {
    run converge edge "${tiny[@]}" -o report
    expect_match 'a run tells what to pick' "$status: $output" '0: # Error against time: edge*What to pick*wrote    report*'
    expect 'the report is seven files' "$(cd report && echo *)" \
        'converge.csv converge.json error-samples.png error-samples.svg error-time.png error-time.svg summary.md'
    expect_match 'the table names its columns' "$(head -1 report/converge.csv)" \
        'function,estimator,m,N,tracer,seed_count,rays,*,seconds,*,cpu_seconds,*,rmse,rmse_ci,*,limited_by'
    expect 'a row a point, each with all columns' "$(awk -F, '{ print NF }' report/converge.csv | uniq -c | awk '{ print $1 }')" 13
    expect 'seeds are counted, of grids one' "$(awk -F, '$4 == 2 { print $2, $6 }' report/converge.csv | xargs)" \
        'stratified 3 random 3 shared 3 uniform 1'
    expect 'rays are N * N a pixel' "$(awk -F, '$2 == "random" { print $7 }' report/converge.csv | xargs)" '120 480 1920'
    run converge edge "${tiny[@]}" --quiet -o again
    expect 'a quiet run is quiet' "$status: $output" '0: '
    untimed report/converge.csv >a
    untimed again/converge.csv >b
    expect_same_file 'two runs differ in times only' a b
    expect_same_file 'the plot against samples is the same file' report/error-samples.png again/error-samples.png
    "$strata" converge edge "${tiny[@]}" --threads 2 --quiet -o threads
    untimed threads/converge.csv >b
    expect_same_file 'errors do not depend on threads' a b
    if command -v python3 >/dev/null; then
        output=$(python3 - report/converge.json <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
rows = {(row["estimator"], row["N"]): row for row in report["rows"]}
slopes = [s for s in report["slopes"] if s["against"] == "samples"]
print(len(report["rows"]), len(slopes), sorted(slopes[0]) == sorted(
    ["estimator", "m", "tracer", "against", "slope", "slope_ci", "factor", "points"]),
    rows["shared", 4]["rmse"] < rows["stratified", 4]["rmse"] < rows["random", 4]["rmse"],
    len(report["bias"]["tests"]), all(test["pass"] for test in report["bias"]["tests"]))
PYTHON
        )
        expect 'the JSON has rows, slopes, tests of bias, and the order that theory knows' "$output" '12 4 True True 6 True'
    fi
}

check_images() {
    local image
    for image in zoneplate checker ramp; do
        run converge "$image" "${tiny[@]}" --quiet -o "$image"
        expect "$image is measured" "$status: $output" '0: '
        expect_match "$image is compared with the exact picture" "$(cat "$image/converge.json")" '*"exact": true*'
    done
    run converge constant "${tiny[@]}" -o constant
    expect_match 'a constant has no error and so no plot' "$status: $output $(cd constant && echo *)" \
        '0: *12 points err by no more than the rounding*converge.csv converge.json summary.md'
    run converge hyperterrain --size 12x7 --N 1,2 --m 4 --estimators stratified,random --seeds 2 --tracers fast,reference -o t
    expect_match 'a surface is compared with the engine, by both tracers' "$status: $(cat t/converge.json)" \
        '0: *"exact": false*"tracer": "reference"*'
    run converge wheel --size 16x16 --N 1,2 --m 4 --estimators super --seeds 2 --quiet -o w
    expect 'with an open shutter grids have random times: seeds count' "$(awk -F, 'NR > 1 { print $2, $6 }' w/converge.csv | xargs)" \
        'super 2 super 2'
}

check_budget_and_signals() {
    local start=$SECONDS
    run converge zoneplate --size 128x128 --budget 15s --quiet -o budget
    expect 'a run with a budget ends in time' "$status: $output $((SECONDS - start <= 17))" '0:  1'
    expect_match 'it says what it left out' "$(cat budget/summary.md)" '*did not suffice for N =*'
    "${interruptible[@]}" "$strata" converge edge --seeds 1000 --N 1,2 --m 4 --quiet -o stopped &
    local pid=$!
    await_handler "$pid"
    sleep 3
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends a run with 130' "$?" 130
    expect_match 'what was measured is reported' "$(cat stopped/summary.md)" '*Interrupted: some points rest on fewer seeds*'
}

run_groups check_refusals check_report check_images check_budget_and_signals
