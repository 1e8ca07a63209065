#!/usr/bin/env bash
# What `strata strip` promises, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--scene terrain --size 32x18 --simd scalar)

check_rendered_on_the_spot() {
    local columns='none; N=2; N=3 m=1 estimator=sobol'
    run strip "${tiny[@]}" --columns "$columns" --crop 4,8,16,16 --zoom 5 --reference 3 --difference --rmse --parts -o a.png
    expect 'a strip is written and said so' "$status: $output" '0: wrote    a.png'
    expect 'with --parts each picture is there' "$(echo *)" 'a-1.exr a-2.exr a-3.exr a.png'
    "$strata" strip "${tiny[@]}" --columns "$columns" --crop 4,8,16,16 --zoom 5 --reference 3 --difference --rmse \
        --threads 1 --quiet -o b.png
    expect_same_file 'equal strips are equal files, whatever the threads' a.png b.png
    "$strata" render terrain --size 32x18 --simd scalar --crop 4,8,16,16 -N 2 --format float --quiet -o whole.exr
    expect_same_file 'a part is the picture that render makes of the crop' whole.exr a-2.exr
    "$strata" strip "${tiny[@]}" --columns "$columns" --crop 4,8,16,16 --zoom 5 --reference 2 --difference --rmse \
        --quiet -o c.png
    expect 'another reference is another strip' "$(cmp -s a.png c.png; echo $?)" 1
    "$strata" strip "${tiny[@]}" --columns "$columns" --crop 4,8,16,16 --zoom 5 --reference 'N=2' --difference --rmse \
        --quiet -o d.png
    expect_same_file 'a column is a reference by its text as by its number' c.png d.png
    run strip "${tiny[@]}" --columns 'N=2' --reference 'N=4 estimator=sobol' --rmse -o e.jpg
    expect 'settings can be the reference, rendered beside the columns' "$status: $output" '0: wrote    e.jpg'
}

check_existing_pictures() {
    local n
    for n in 1 2; do "$strata" render terrain --size 32x18 -N $n --quiet --format float -o $n.exr -o $n.png; done
    run strip 1.exr 2.exr --crop 2,2,12,10 -o exr.png
    expect 'EXR pictures make a strip' "$status: $output" '0: wrote    exr.png'
    # A format is told by the first bytes: under one name both strips have the same metadata.
    "$strata" render terrain --size 32x18 -N 2 --exposure 0.7 --quiet --format float -o bright.exr -o bright.png
    mkdir codes light
    cp bright.png codes/picture
    cp bright.exr light/picture
    local kind
    for kind in codes light; do (cd $kind && "$strata" strip picture --crop 2,2,12,10 --quiet -o s.png); done
    expect_same_file 'the PNG and the EXR of a render are shown alike, its exposure included' codes/s.png light/s.png
    cp bright.exr before.exr
    "$strata" strip bright.exr before.exr --reference before.exr --rmse --quiet -o twice.png
    expect_same_file 'a strip leaves the pictures that it shows alone' bright.exr before.exr
    run strip 1.exr --scene terrain --size 32x18 --columns 'N=2' --reference 2.exr --difference -o mixed.png
    expect 'pictures stand beside columns that are rendered' "$status: $output" '0: wrote    mixed.png'
}

check_refusals() {
    "$strata" render terrain --size 32x18 -N 1 --quiet -o a.exr
    "$strata" render terrain --size 30x18 -N 1 --quiet -o b.exr
    "$strata" render terrain --size 32x18 -N 1 --crop 4,4,12,12 --quiet -o c.exr
    : >empty.png
    head -c 900 a.exr >damaged.exr
    local before
    before=$(echo *)
    refuses 'nothing to show is refused' 2 '*give pictures*' strip
    refuses 'a scene without columns is refused' 2 '*go together*' strip --scene terrain
    refuses 'columns without a scene are refused' 2 '*go together*' strip a.exr --columns N=2
    refuses 'pictures of different size are refused by name' 2 '*a.exr has 32x18*b.exr has 30x18*' strip a.exr b.exr
    refuses 'pictures of different size are refused with a crop too' 2 '*32x18*30x18*' strip a.exr b.exr --crop 0,0,4,4
    refuses 'a reference of another size is refused' 2 '*32x18*30x18*' strip a.exr --reference b.exr --rmse
    refuses 'a crop outside of the frame is refused' 2 '*--crop 0,0,33,4:*x1 <= 32*' strip a.exr --crop 0,0,33,4
    refuses 'a crop outside of a picture that is a crop is refused' 2 '*c.exr holds pixels 4,4,12,12 alone*' strip a.exr c.exr \
        --crop 0,0,8,8
    refuses 'a missing picture is named' 2 '*nowhere.exr*does not exist*' strip nowhere.exr
    refuses 'an empty picture is named' 2 '*empty.png*' strip empty.png
    refuses 'a damaged picture is named' 2 '*damaged.exr*' strip damaged.exr
    refuses 'N = 0 is refused' 2 '*N=0*sampling.N*1 to 64*' strip "${tiny[@]}" --columns 'none; N=0'
    refuses 'an unknown key gets the nearest' 2 "*did you mean*" strip "${tiny[@]}" --columns 'surface.octvaes=2'
    refuses 'an empty column is refused' 2 '*empty*' strip "${tiny[@]}" --columns 'N=1;;N=2'
    refuses 'a difference needs a reference' 2 '*need --reference*' strip a.exr --difference
    refuses 'a reference column that is not there is refused' 2 '*column 1 to 1*' strip a.exr --reference 2 --rmse
    refuses 'a zoom of 0 is refused' 2 '*--zoom 0: allowed*1 to 64*' strip a.exr --zoom 0
    refuses 'labels are one a picture' 2 '*2 labels for 1 pictures*' strip a.exr --labels 'a; b'
    refuses 'a scale without height is refused' 2 '*--difference-top 0*' strip a.exr --reference 1 --difference --difference-top 0
    refuses 'an EXR is no strip' 2 '*.png*' strip a.exr -o strip.exr
    refuses 'a missing folder is named' 1 '*nowhere*' strip a.exr -o nowhere/s.png
    cp a.exr s-1.exr
    refuses 'a part does not replace a picture of the strip' 2 '*s-1.exr*is a picture of the strip*' strip s-1.exr --parts -o s.png
    rm s-1.exr
    expect 'nothing is written when something is refused' "$(echo *)" "$before"
}

run_groups check_rendered_on_the_spot check_existing_pictures check_refusals
