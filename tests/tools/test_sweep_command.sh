#!/usr/bin/env bash
# What `strata sweep` promises, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(terrain --size 24x12 --simd scalar --reference-N 3)

# Times of change, to the nanosecond, of all that is in a folder.
times() { stat -c '%y %n' "$1"/*; }

# sweep.csv without its two columns of times.
untimed() { awk -F, 'NR==1{for(i=1;i<=NF;i++)if($i!~/seconds/)keep[i]=1}{for(i=1;i<=NF;i++)if(keep[i])printf "%s,",$i;print ""}' "$1"; }

# cells TABLE COLUMN ROW: of the rows whose first cell begins so.
cells() {
    awk -F, -v column="$2" -v row="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == column) at = i }
        NR > 1 && index($1, row) == 1 { print $at }' "$1"
}

check_grid_and_resumption() {
    run sweep "${tiny[@]}" --N 1,2 --m 1,4 -o s
    expect_match 'a sweep says what it wrote and how good its references are' "$status: $output" \
        '0: error *reference_m01.exr*reference_m04.exr*wrote *s: sweep.png, sweep.csv, sweep.json and 4 pictures'
    expect 'each picture is there, each filter has a reference, and sheet and tables' "$(cd s && echo *)" \
        "N01_m01.exr N01_m04.exr N02_m01.exr N02_m04.exr reference_m01.exr reference_m01_a.exr reference_m01_b.exr \
reference_m04.exr reference_m04_a.exr reference_m04_b.exr sweep.csv sweep.json sweep.png"
    expect 'the table has a line a picture' "$(wc -l <s/sweep.csv)" 5
    "$strata" render terrain --size 24x12 --simd scalar -N 2 -m 4 --format float --quiet -o alone.exr
    expect_same_file 'a cell is the picture that render makes' alone.exr s/N02_m04.exr

    local before
    before=$(times s)
    run sweep "${tiny[@]}" --N 1,2 --m 1,4 -o s
    expect_match 'a finished sweep renders nothing and says so' "$status: $output" '0: kept *all 8 pictures: nothing to render*'
    expect 'a finished sweep leaves every file as it is' "$(times s)" "$before"

    "$strata" sweep "${tiny[@]}" --N 1,2 --m 1,4 --threads 1 --quiet -o t
    expect_same_file 'equal sweeps have equal sheets, whatever the threads' s/sweep.png t/sweep.png
    expect_same_file 'equal sweeps have equal references' s/reference_m04.exr t/reference_m04.exr
    expect 'equal sweeps have equal tables but for times' "$(untimed t/sweep.csv)" "$(untimed s/sweep.csv)"

    before=$(grep -A6 '"N01_m04.exr": {' s/sweep.json)
    rm s/N02_m01.exr s/reference_m04_b.exr s/sweep.png
    truncate -s 700 s/N01_m01.exr
    run sweep "${tiny[@]}" --N 1,2 --m 1,4 -o s
    expect_match 'only what is missing or damaged is rendered' "$status: $output" '0: damaged  s/N01_m01.exr: *it is made again*kept     5 pictures, 3 to render*'
    expect_same_file 'what was missing is as it was' s/N02_m01.exr t/N02_m01.exr
    expect_same_file 'what was damaged is as it was' s/N01_m01.exr t/N01_m01.exr
    cp s/sweep.json whole.json
    truncate -s 100 s/sweep.json
    run sweep "${tiny[@]}" --N 1,2 --m 1,4 -o s
    expect_match 'a cut table of times is said' "$status: $output" '0: damaged  s/sweep.json: *times*lost*nothing to render*'
    mv whole.json s/sweep.json
    expect_same_file 'the sheet is as it was' s/sweep.png t/sweep.png
    expect 'the times of kept pictures are kept' "$(grep -A6 '"N01_m04.exr": {' s/sweep.json)" "$before"
    run sweep "${tiny[@]}" --N 1,2 --m 1,4 --set surface.gain=0.4 -o s
    expect_match 'pictures of another scene are not taken for this one' "$status: $output" '0: error*'
}

check_interruption() {
    "${interruptible[@]}" "$strata" sweep terrain --size 160x90 --simd scalar --N 1,40 --reference none --quiet -o s &
    local child=$! i
    for ((i = 0; i < 200; i++)); do
        [[ -e s/N01.exr ]] && break
        sleep 0.05
    done
    kill -TERM "$child"
    wait "$child"
    expect 'an interrupted sweep ends with the signal' $? 143
    expect 'an interrupted sweep keeps what is finished, and its times' "$(cd s && echo *)" 'N01.exr sweep.json'
    local first
    first=$(stat -c %y s/N01.exr)
    run sweep terrain --size 160x90 --simd scalar --N 1,2 --reference none -o s
    expect_match 'the sweep goes on from there' "$status: $output" '0: kept *1 pictures, 1 to render*'
    expect 'what was finished is not rendered again' "$(stat -c %y s/N01.exr)" "$first"
    expect 'the times from before the interruption are in the table' "$(cells s/sweep.csv seconds N01 | awk '{ print ($1 > 0) }')" 1
}

check_axes_and_references() {
    run sweep massif --size 8x8 --N 1 --axis relief.crests.octaves=2,3 --reference none --quiet -o relief
    expect 'a key of a relief term is an axis' "$status: $output$(cd relief && echo octaves*)" '0: octaves02.exr octaves03.exr'
    run sweep "${tiny[@]}" --estimator none,sobol --axis octaves=2,3 -N 2 --crop 2,2,12,9 -o any
    expect_match 'any two keys are axes' "$status: $(echo any/*)" '0: *estimatornone_octaves02.exr*octaves03.exr*reference_octaves02.exr*'
    run sweep zoneplate --size 24x12 --rows seed=1,2 --reference none -o one
    expect 'one axis alone is fine, and none is a reference' "$status: $(cd one && echo *)" \
        '0: seed01.exr seed02.exr sweep.csv sweep.json sweep.png'
    expect 'without a reference there are no errors' "$(cells one/sweep.csv rmse seed)$(cells one/sweep.csv near_reference_error seed)" ''
    "$strata" render zoneplate --size 24x12 -N 8 --quiet --format float -o ref.exr
    run sweep zoneplate --size 24x12 --N 1,8 --reference ref.exr -o given
    expect 'a given reference measures the same picture as no error' "$status: $(cells given/sweep.csv rmse N08 | sed 's/\.0$//')" '0: 0'
    run sweep zoneplate --size 24x12 --N 1,16 --estimator sobol --reference-N 4 -o near
    expect 'errors that are partly the reference'"'"'s are marked' "$(awk -F, 'NR>1{print $NF}' near/sweep.csv | tr '\n' ' ')" 'no yes '
    run sweep zoneplate --size 24x12 --N 4 --estimator super,stratified --m 1 --reference-N 4 -o box
    expect 'box and order 1 share their reference' "$(cd box && echo reference*)" \
        'reference_box.exr reference_box_a.exr reference_box_b.exr'
}

check_refusals() {
    refuses 'nothing to vary is refused' 2 '*nothing to vary*' sweep terrain
    refuses 'N = 0 is refused' 2 '*--N 0: sampling.N: out of range*1 to 64*' sweep "${tiny[@]}" --N 1,0
    refuses 'an axis of a term that the scene lacks is refused' 2 '*relief.crusts.octaves*did you mean*' \
        sweep massif --size 8x8 --N 1 --axis relief.crusts.octaves=1,2
    refuses 'an unknown axis gets the nearest' 2 "*octvaes*did you mean*" sweep "${tiny[@]}" --axis surface.octvaes=1,2
    refuses 'an unknown estimator gets the nearest' 2 "*did you mean 'sobol'*" sweep "${tiny[@]}" --estimator sobl,none
    refuses 'of a list given twice the last counts' 2 '*sampling.N: out of range (99)*' sweep "${tiny[@]}" --N 1,2 --N 99
    refuses 'the same axis twice is refused' 2 '*both vary sampling.N*' sweep "${tiny[@]}" --N 1,2 --rows N=3,4
    refuses 'an empty list is refused' 2 '*an empty value*' sweep "${tiny[@]}" --N ''
    refuses 'a third axis is refused' 2 '*a third axis*' sweep "${tiny[@]}" --N 1,2 --m 1,2 --seed 1,2
    refuses 'too many pictures are refused' 2 '*at most 400*' sweep "${tiny[@]}" --N "$(seq -s, 1 30)" --m "$(seq -s, 1 30)"
    refuses 'a crop outside of the frame is refused' 2 '*--crop 0,0,25,4:*' sweep "${tiny[@]}" --N 1,2 --crop 0,0,25,4
    refuses 'a missing reference is named' 2 '*nowhere.exr*' sweep terrain --N 1,2 --reference nowhere.exr
    "$strata" render terrain --size 8x8 -N 1 --quiet -o small.exr
    refuses 'a reference of another size is refused' 2 '*8x8 pixels*24x12*' sweep terrain --size 24x12 --N 1,2 --reference small.exr
    : >file
    refuses 'a folder that cannot be made is named' 1 '*file/s*' sweep "${tiny[@]}" --N 1,2 -o file/s
    mkdir -p taken/N01.exr
    refuses 'a picture that cannot be written is found out first' 1 '*N01.exr*folder*' sweep "${tiny[@]}" --N 1,2 -o taken
    expect 'nothing is written when something is refused' "$(echo * taken/*)" 'file small.exr taken taken/N01.exr'
}

run_groups check_grid_and_resumption check_interruption check_axes_and_references check_refusals
