#!/usr/bin/env bash
# What `strata explain` promises on the command line, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 32x18 -N 2)

check_plan() {
    run explain terrain "${tiny[@]}"
    expect_match 'a plan tells what is needed, what is left out, the octaves and the costs' "$status: $output" \
        '0: terrain  32x18*needed *2-D noise*left out *3-D noise*octave *12 *cost *noise_evaluations*a pilot of*'
    expect 'a plan fits on a screen' "$(($(wc -l <<<"$output") <= 64)) $(awk 'length > 120' <<<"$output" | wc -l)" '1 0'
    run explain terrain "${tiny[@]}" --set sun.shadows=false
    expect_match 'what is switched off is left out, with the key that did it' "$output" '*left out*shadow rays *sun.shadows is false*'
    run explain terrain "${tiny[@]}" --set shutter.open_s=0.02
    expect_match 'an open shutter over a scene at rest draws no times' "$output" '*left out*time samples *nothing moves*'
    run explain isosurface "${tiny[@]}"
    expect_match 'what moves is needed' "$output" '*time samples *something moves*left out*'
    run explain wheel "${tiny[@]}" -m 40
    expect_match 'orders beyond the table are told' "$output" '*exact inverse *microseconds*inverse table *m = 40 is above 32*'
    run explain terrain --no-pilot
    expect_match 'without a pilot what takes one is not told' "$status: $output" '0: *noise_evaluations *-*No pilot*'
    run explain terrain "${tiny[@]}" --quiet
    expect 'quiet is quiet' "$status: $output" '0: '
}

check_stats() {
    local scene
    for scene in terrain isosurface zoneplate; do
        "$strata" render "$scene" "${tiny[@]}" --quiet -o a.exr -o a.png --stats "$scene.json"
        run explain "$scene" "${tiny[@]}" --stats "$scene.json" --json plan.json
        expect_match "the actual costs of $scene stand beside the predicted ones" "$status: $output" \
            '0: *predicted *actual *predicted/actual*Actual: *'
        expect "memory of $scene is predicted within a factor of 1.5" \
            "$(awk '/^peak_memory/ { print ($NF > 0.667 && $NF < 1.5) }' <<<"$output")" 1
        expect "rays of $scene are exact" "$(awk '/^rays/ { print $NF }' <<<"$output")" 1.00
    done
    run explain a.exr --stats zoneplate.json
    expect_match 'a picture that strata wrote is explained with its settings' "$status: $output" '0: *zoneplate*'
    "$strata" render terrain "${tiny[@]}" --passes 3 --quiet -o three.exr --stats three.json
    run explain terrain "${tiny[@]}" --stats three.json
    expect_match 'counts of several passes are those of one' "$status: $output" '0: *3 passes are averaged*Actual: *one of 3 passes*'
    expect 'rays of a pass are exact' "$(awk '/^rays/ { print $NF }' <<<"$output")" 1.00
    run explain three.exr --no-pilot
    expect_match 'a picture tells its passes' "$status: $output" '0: *more passes *3 passes*'
    "$strata" render terrain "${tiny[@]}" --aov steps --quiet -o costly.exr --stats costly.json
    run explain terrain "${tiny[@]}" --aov steps,evals --stats costly.json
    expect_match 'what pixels cost is explained as it is rendered' "$status: $output" '0: *other channels *steps.Y, evals.Y*'
    run explain costly.exr --no-pilot
    expect_match 'a picture tells its other channels' "$status: $output" '0: *other channels *steps.Y*'
    refuses 'other channels of several passes are refused as by render' 2 '*--aov: allowed with one pass*' \
        explain terrain --aov steps --passes 2
    refuses 'an unknown AOV gets the known ones' 2 '*--aov step: allowed: all, or some of *steps,evals*' explain terrain --aov step
    refuses 'counts of another scene are refused' 2 '*terrain.json: of a render of another scene*' \
        explain isosurface "${tiny[@]}" --stats terrain.json
    refuses 'counts with another N are refused' 2 '*another setting*' explain terrain --size 32x18 -N 3 --stats terrain.json
    refuses 'counts of another crop are refused' 2 '*crop*' explain terrain "${tiny[@]}" --crop 0,0,4,4 --stats terrain.json
    refuses 'counts of another tracer are refused' 2 '*tracer*' explain terrain "${tiny[@]}" --tracer reference --stats terrain.json
    refuses 'a missing record is refused' 2 '*none.json: cannot be read*' explain terrain --stats none.json
    run explain wheel --size 2x2
    expect_match 'a share of all rays reads as that' "$output" '*, 100 % of all*'
    refuses 'a folder is no record, and says so' 2 '*--stats .: cannot be read: Is a directory' explain terrain --stats .
    refuses 'a picture is no record' 2 '*a.png: not JSON*' explain terrain --stats a.png
}

check_json() {
    "$strata" explain terrain "${tiny[@]}" --json plan.json --quiet --threads 1
    local key missing=
    for key in scene version width height crop estimator N m tracer simd_target threads features octaves pilot recorded costs; do
        grep -q "^  \"$key\": " plan.json || missing+=" $key"
    done
    expect 'the JSON has every key that the help names' "$missing" ''
    "$strata" explain terrain "${tiny[@]}" --json again.json --quiet --threads 1
    expect 'but for times and memory equal plans are equal files' \
        "$(diff <(awk '/_seconds|"seconds|memory/ { skip = 2 } skip-- <= 0' plan.json) \
            <(awk '/_seconds|"seconds|memory/ { skip = 2 } skip-- <= 0' again.json))" ''
    refuses 'a folder that is not there is refused' '[12]' '*nowhere/plan.json*' explain terrain --json nowhere/plan.json
    "$strata" scenes terrain >mine.toml
    cp mine.toml kept.toml
    refuses 'the scene itself is not overwritten' 2 '*mine.toml*a file of its own*' explain mine.toml --json mine.toml
    expect_same_file 'the scene is as it was' mine.toml kept.toml
}

check_refusals() {
    refuses 'an unknown tracer is refused' 2 '*--tracer quick: allowed: fast, reference*' explain terrain --tracer quick
    refuses 'an unknown SIMD target is refused' 2 '*--simd mmx*' explain terrain --simd mmx
    refuses 'too many threads are refused' 2 '*--threads 5000*' explain terrain --threads 5000
    refuses 'a crop outside of the frame is refused' 2 '*--crop 0,0,33,4*' explain terrain "${tiny[@]}" --crop 0,0,33,4
    refuses 'an unknown scene gets the nearest' 2 "*did you mean 'hills'*" explain hils
    refuses 'an unknown option gets the nearest' 2 "*did you mean '--no-pilot'*" explain terrain --no-pilo
    expect 'nothing was written' "$(ls -A)" ''
}

run_groups check_plan check_stats check_json check_refusals
