#!/usr/bin/env bash
# What tone curves promise on the command line, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(terrain --size 24x13 -N 2 --simd scalar --quiet --exposure 3)

check_pictures() {
    "$strata" render "${tiny[@]}" -o plain.png -o plain.exr
    "$strata" render "${tiny[@]}" --tone none -o none.png
    expect_same_file 'tone none is what a scene without the key gets' plain.png none.png
    local curve
    for curve in agx reinhard; do
        "$strata" render "${tiny[@]}" --tone $curve -o $curve.png -o $curve.exr -o $curve.tif
        expect "$curve gives another PNG" "$(cmp -s plain.png $curve.png; echo $?)" 1
        "$strata" render "${tiny[@]}" --tone $curve --threads 1 --tile 5 -o again.png
        expect_same_file "$curve gives equal files, whatever threads and tiles" $curve.png again.png
        "$strata" render $curve.exr --quiet -o again.png -o again.tif
        expect_same_file "an EXR knows of $curve, and makes the same PNG" $curve.png again.png
        expect_same_file "an EXR knows of $curve, and makes the same TIFF" $curve.tif again.tif
        run strip plain.exr $curve.exr --reference 1 --rmse --labels 'a; b' --quiet -o strip-$curve.png
        expect "an EXR of $curve can be compared" "$status" 0
    done
    # Under one name, so that all else of the strips' metadata is equal.
    mkdir linear curved
    cp plain.exr linear/a.exr
    cp reinhard.exr curved/a.exr
    local folder
    for folder in linear curved; do
        (cd $folder && "$strata" strip a.exr --parts --quiet -o s.png)
    done
    expect_same_file 'EXR stays linear, whatever the curve' linear/s-1.exr curved/s-1.exr
    expect 'a strip shows the curve of its first picture' "$(cmp -s linear/s.png curved/s.png; echo $?)" 1
}

# What a strip of one column shows, as light, so that nothing but its pixels counts.
shown() { # folder arguments...
    mkdir "$1"
    (cd "$1" && "$strata" strip --scene terrain --size 24x13 --simd scalar "${@:2}" --labels x --quiet -o s.png &&
        "$strata" strip s.png --parts --quiet -o t.png)
}

check_columns() {
    shown none --columns 'tone=none'
    shown column --columns 'tone=agx'
    shown scene --tone agx --columns 'N=4'
    expect_same_file 'a column shows its own curve as it does the scene'"'"'s' column/t-1.exr scene/t-1.exr
    expect 'which is another picture' "$(cmp -s none/t-1.exr column/t-1.exr; echo $?)" 1
}

check_refusals() {
    "$strata" render "${tiny[@]}" --tone agx -o agx.png -o agx.exr -o agx.tif
    "$strata" render "${tiny[@]}" --set film.saturation=0.5 -o pale.png
    local before
    before=$(echo *)
    local codes='*the tone curve agx is in its codes*allowed: the same render as EXR*'
    refuses 'a strip refuses codes behind a curve' 2 "$codes" strip agx.exr agx.png --parts -o s.png
    refuses 'and as a reference' 2 "$codes" strip agx.exr --reference agx.tif --rmse -o s.png
    refuses 'a sweep refuses them as a reference' 2 "$codes" \
        sweep terrain --size 24x13 --N 1,2 --reference agx.png -o sweep
    refuses 'codes of another saturation are no light either' 2 '*a saturation of 0.5 is in its codes*' \
        strip pale.png -o s.png
    refuses 'an unknown curve is refused' 2 '*--tone filmic*film.tone*"none", "reinhard", "agx"*' \
        render "${tiny[@]}" --tone filmic -o x.png
    refuses 'a white balance that takes a channel away is refused' 2 '*film.white_balance*0.01 to 100*' \
        render "${tiny[@]}" --set 'film.white_balance=[1, 0, 1]' -o x.png
    refuses 'a contrast that agx cannot have is refused' 2 '*film.contrast*0.7 to 2*' \
        render "${tiny[@]}" --tone agx --set film.contrast=0.5 -o x.png
    expect 'refusals write nothing' "$(echo *)" "$before"
}

check_sweep() {
    run sweep terrain --size 24x13 --simd scalar --N 1 --axis tone=none,reinhard,agx --reference-N 2 --quiet -o curves
    expect 'curves of a sweep share their reference, which is light' "$status: $(cd curves && echo reference*)" \
        '0: reference.exr reference_a.exr reference_b.exr'
    expect 'and have equal errors' "$(awk -F, 'NR>1{print $9}' curves/sweep.csv | sort -u | wc -l | tr -d ' ')" 1
}

run_groups check_pictures check_columns check_refusals check_sweep
