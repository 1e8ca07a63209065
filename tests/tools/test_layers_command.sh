#!/usr/bin/env bash
# What channels beside colour promise on the command line, shown with tiny pictures; other programs read them.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(terrain --size 24x13 -N 2 --simd scalar --quiet)

has_oiiotool() {
    [[ -n $(command -v oiiotool) ]] && return
    echo 'oiiotool is missing (openimageio-tools): what it reads is not checked'
    return 1
}

channels_of() { oiiotool --info -v "$1" | sed -n 's/^ *channel list: *//p'; } # picture

check_names() {
    has_oiiotool || return 0
    "$strata" render "${tiny[@]}" --aov N,Z,albedo,depth -o a.exr
    expect 'an EXR has colour, depth and layers by the names that other programs read' "$(channels_of a.exr)" \
        'R (half), G (half), B (half), Z (float), N.X (float), N.Y (float), N.Z (float), albedo.R (float), albedo.G (float), albedo.B (float), depth.Y (float)'
    expect_match 'and says how each is filtered' "$(oiiotool --info -v a.exr)" \
        '*strata:aov:N: "nearest; unit vector; *'
    "$strata" render "${tiny[@]}" --aov N,Z --layer-prefix View -o b.exr
    expect 'a prefix goes in front of layers, and depth becomes one' "$(channels_of b.exr)" \
        'R (half), G (half), B (half), View.N.X (float), View.N.Y (float), View.N.Z (float), View.Z.Z (float)'
    "$strata" render b.exr --quiet -o again.exr
    expect_same_file 'a picture rendered again has its prefix' b.exr again.exr
}

check_sum() {
    has_oiiotool || return 0
    "$strata" render "${tiny[@]}" --aov sun,sky,bounce,air,background --format float -o a.exr
    local layer
    for layer in sun sky bounce air background; do
        oiiotool a.exr --ch "R=$layer.R,G=$layer.G,B=$layer.B" -o $layer.exr
    done
    oiiotool sun.exr sky.exr --add bounce.exr --add air.exr --add background.exr --add -o sum.exr
    oiiotool a.exr --ch R,G,B -o colour.exr
    run_oiiotool --fail 1e-6 --hardfail 1e-6 sum.exr colour.exr --diff
    expect_match 'oiiotool adds the layers up to the picture' "$code: $output" '0: *PASS*'
    run_oiiotool --fail 1e-6 --hardfail 1e-6 sun.exr colour.exr --diff
    expect_match 'and sees what lacks a layer' "$code: $output" '[12]: *FAILURE*'
}

run_oiiotool() { # arguments...: sets output and code
    output=$(oiiotool "$@" 2>&1)
    code=$?
}

check_separate() {
    "$strata" render "${tiny[@]}" --aov N,Z,sun --layers separate -o a.exr -o a.png
    expect 'separate layers are files named like the EXR' "$(echo *)" 'a.N.exr a.Z.exr a.exr a.png a.sun.exr'
    "$strata" render "${tiny[@]}" -o plain.exr
    has_oiiotool || return 0
    expect 'and the picture has colour alone' "$(channels_of a.exr)" "$(channels_of plain.exr)"
    expect 'a layer has red, green and blue' "$(channels_of a.N.exr)" 'R, G, B'
    "$strata" render "${tiny[@]}" --aov N -o one.exr
    oiiotool one.exr --ch R=N.X,G=N.Y,B=N.Z -o N.exr
    run_oiiotool N.exr a.N.exr --diff
    expect_match 'which are the components' "$code: $output" '0: *PASS*'
    "$strata" render a.exr --quiet -o b.exr
    expect_same_file 'a picture rendered again has its layers again' a.N.exr b.N.exr
}

# MurmurHash3_x86_32 once more, from its published description.
murmur() { # text
    local text=$1 hash=0 block k i length=${#1} byte
    for ((block = 0; block * 4 < length; ++block)); do
        k=0
        for ((i = 3; i >= 0; --i)); do
            byte=0
            ((block * 4 + i < length)) && printf -v byte %d "'${text:block*4+i:1}"
            k=$((k << 8 | byte))
        done
        k=$((k * 0xcc9e2d51 & 0xffffffff))
        k=$(((k << 15 | k >> 17) & 0xffffffff))
        hash=$((hash ^ (k * 0x1b873593 & 0xffffffff)))
        if ((block * 4 + 4 <= length)); then
            hash=$(((hash << 13 | hash >> 19) & 0xffffffff))
            hash=$(((hash * 5 + 0xe6546b64) & 0xffffffff))
        fi
    done
    hash=$((hash ^ length))
    hash=$(((hash ^ hash >> 16) * 0x85ebca6b & 0xffffffff))
    hash=$(((hash ^ hash >> 13) * 0xc2b2ae35 & 0xffffffff))
    printf %08x $((hash ^ hash >> 16))
}

check_mattes() {
    local grounds=(--set 'ground.rock.colour=[0.3,0.3,0.3]') key part
    cat >ground.toml <<'TOML'
image = "surface"
[[ground]]
name = "rock"
[[ground]]
name = "snow"
height_from = 0.4
noise_size = 0.5
[[ground]]
name = "upper-snow_2"
height_from = 1.0
TOML
    local small=(ground.toml --size 70x130 -N 2 --simd scalar --quiet)
    "$strata" render "${small[@]}" "${grounds[@]}" --aov mask,cryptomatte -o a.exr
    for part in 1 2; do
        "$strata" render "${small[@]}" "${grounds[@]}" --aov mask,cryptomatte --shard "$part/2" -o "part$part.exr"
    done
    run merge part1.exr part2.exr -o whole.exr
    expect_same_file 'parts of a picture with mattes become the whole, header and all' a.exr whole.exr
    "$strata" render a.exr --quiet -o again.exr
    expect_same_file 'a picture rendered again has its mattes again' a.exr again.exr
    refuses 'layers do not fit a file of three channels' 2 '*--aov mask: allowed with --layers one*' \
        render "${small[@]}" --aov mask --layers separate -o b.exr
    refuses 'without layers of ground there is nothing to mask' 2 '*--aov cryptomatte: allowed of a scene that has layers of ground*' \
        render "${tiny[@]}" --aov cryptomatte -o b.exr
    has_oiiotool || return 0
    expect 'masks are named after their layers, and mattes as Cryptomatte has it' "$(channels_of a.exr)" \
        'R (half), G (half), B (half), crypto_ground00.r (float), crypto_ground00.g (float), crypto_ground00.b (float), crypto_ground00.a (float), crypto_ground01.r (float), crypto_ground01.g (float), crypto_ground01.b (float), crypto_ground01.a (float), mask.rock (float), mask.snow (float), mask.upper-snow_2 (float)'
    key=$(murmur crypto_ground)
    local info
    info=$(oiiotool --info -v a.exr)
    expect_match 'the header has the ids of the names, by the hash' "$info" \
        "*cryptomatte/${key:0:7}/manifest: *rock*$(murmur rock)*snow*$(murmur snow)*upper-snow_2*$(murmur upper-snow_2)*"
    expect_match 'and the name' "$info" "*cryptomatte/${key:0:7}/name: \"crypto_ground\"*"
    oiiotool a.exr --ch mask.rock,mask.snow,mask.upper-snow_2 --chsum:weight=1,1,1 -o masks.exr
    oiiotool a.exr --ch crypto_ground00.g,crypto_ground00.a,crypto_ground01.g --chsum:weight=1,1,1 -o pairs.exr
    run_oiiotool --fail 1e-6 --hardfail 1e-6 masks.exr pairs.exr --diff
    expect_match 'pairs cover as much as masks' "$code: $output" '0: *PASS*'
    "$strata" render "${small[@]}" "${grounds[@]}" --aov mask --layer-prefix View -o c.exr
    expect_match 'a prefix goes in front of masks' "$(channels_of c.exr)" '*View.mask.rock (float)*'
}

check_all() {
    run render "${tiny[@]}" --aov all --estimator random -o a.exr
    expect 'all channels there are' "$status" 0
    expect 'are named in the metadata' "$(grep -ac 'strata:aov:variance' a.exr)" 1
    run render "${tiny[@]}" --aov all --estimator sobol -o b.exr
    expect 'or all that the estimator has' "$status $(grep -ac 'strata:aov:variance' b.exr)" '0 0'
    "$strata" render "${tiny[@]}" --aov all --estimator random --crop 3,2,20,11 --threads 1 --tile 3 -o c.exr
    "$strata" render c.exr --quiet --threads 2 -o d.exr
    expect_same_file 'threads and tiles change no byte' c.exr d.exr
    has_oiiotool || return 0
    oiiotool a.exr --crop 17x9+3+2 -o cut.exr
    run_oiiotool cut.exr c.exr --diff
    expect_match 'and a crop no channel' "$code: $output" '0: *PASS*'
}

check_refusals() {
    local before
    before=$(echo *)
    refuses 'an unknown channel gets the known ones' 2 '*--aov depht: allowed: all, or some of Z,depth,*' \
        render "${tiny[@]}" --aov depht -o a.exr
    refuses 'what an estimator does not tell is refused' 2 '*--aov variance: allowed with -N of 2 or more and one of the estimators stratified, random*' \
        render "${tiny[@]}" --aov variance --estimator sobol -o a.exr
    refuses 'channels that have no place are refused' 2 '*--aov N: allowed with an EXR*' \
        render "${tiny[@]}" --aov N -o a.png
    refuses 'an unknown arrangement is refused' 2 '*--layers two: allowed: one, separate*' \
        render "${tiny[@]}" --aov N --layers two -o a.exr
    refuses 'a prefix that would be two layers is refused' 2 '*--layer-prefix a.b: allowed: letters*' \
        render "${tiny[@]}" --aov N --layer-prefix a.b -o a.exr
    refuses 'a layer does not take the place of a picture' 2 '*a.N.exr*' \
        render "${tiny[@]}" --aov N --layers separate -o a.exr -o a.N.exr
    refuses 'separate layers do not go to standard output' 2 '*--layers separate: allowed with outputs that are files*' \
        render "${tiny[@]}" --aov N --layers separate -o -
    expect 'refusals write nothing' "$(echo *)" "$before"
}

run_groups check_names check_sum check_separate check_mattes check_all check_refusals
