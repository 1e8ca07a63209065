#!/usr/bin/env bash
# What pictures of other programs are read as, and what of ours others can read, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

# Numbers as little-endian bytes.
le16() { printf '%b' "\\x$(printf %02x $(($1 & 255)))\\x$(printf %02x $(($1 >> 8 & 255)))"; }
le32() { le16 $(($1 & 65535)) && le16 $(($1 >> 16 & 65535)); }
entry() { le16 "$1" && le16 4 && le32 1 && le32 "$2"; } # tag number: one number of 32 bits

# An uncompressed TIFF of 4x2 pixels in floating point, whose values are given as bit patterns; the last one is repeated.
float_tiff() { # channels pattern...
    local channels=$1 count i pattern=0
    count=$((8 * channels))
    shift
    printf 'II*\0' && le32 $((8 + 4 * count))
    for ((i = 0; i < count; ++i)); do
        if (($#)); then pattern=$1 && shift; fi
        le32 "$pattern"
    done
    le16 10
    entry 256 4 && entry 257 2 && entry 258 32 && entry 259 1 # width, height, bits of a value, no compression
    entry 262 $((channels == 3 ? 2 : 1)) && entry 273 8       # RGB or grey, where the values begin
    entry 277 "$channels" && entry 278 2 && entry 279 $((4 * count)) && entry 339 3
    le32 0
}

quarter=0x3e800000 half=0x3f000000 nan=0x7fc00000 infinity=0x7f800000

check_floating_tiff() {
    local constant=(constant --size 4x2 --set constant.value=0.25 --set surface.octaves=1 --N 1)
    float_tiff 3 $quarter >a.tif
    float_tiff 1 $quarter >grey.tif
    local kind
    for kind in a grey; do
        run sweep "${constant[@]}" --reference $kind.tif -o $kind --quiet
        expect "a sweep takes a TIFF in floating point for light ($kind)" "$status: $output" '0: '
        expect_match 'and finds no error where there is none' "$(grep -o '"rmse": [^,]*' $kind/sweep.json)" '"rmse": 0*'
        expect 'none at all' "$(grep -c '"rmse": 0\.0$\|"rmse": 0$' <(grep -o '"rmse": [^,]*' $kind/sweep.json))" 1
    done
    float_tiff 3 $half >b.tif
    run strip a.tif grey.tif b.tif --reference 1 --rmse --difference --parts -o s.png
    expect 'a strip shows grey beside colour' "$status: $output" '0: wrote    s.png'
    run strip s-1.exr s-2.exr --reference 1 --rmse --parts -o t.png
    expect_same_file 'grey has the same light in all three channels' <(tail -c 24 s-1.exr) <(tail -c 24 s-2.exr)
}

check_not_finite() {
    float_tiff 3 $quarter $nan $quarter $quarter $quarter $quarter $infinity $quarter >n.tif
    float_tiff 3 $quarter >a.tif
    run strip n.tif a.tif --reference a.tif --difference --rmse --parts -o s.png
    expect_match 'pixels that are not finite are counted and the file is named' "$status: $output" \
        '0: strata: warning: n.tif: 2 pixels are not finite, first (0,0) = (0.25, nan, 0.25)*wrote *s.png'
    run strip s-1.exr a.tif -o t.png
    expect_match 'a part keeps them' "$status: $output" '0: *s-1.exr: 2 pixels are not finite*t.png'
    run strip a.tif --reference n.tif --rmse -o u.png
    expect_match 'those of the reference are told too' "$status: $output" '0: *n.tif: 2 pixels are not finite*u.png'
    run strip n.tif a.tif --quiet -o q.png
    expect 'quietly nothing is said' "$status: $output" '0: '
    run sweep constant --size 4x2 --N 1 --reference n.tif -o w
    expect_match 'a sweep names the reference that has them' "$status: $output" '0: *warning: n.tif: 2 pixels are not finite*'
}

check_clipping() {
    local bright=(terrain --size 32x18 --set sun.intensity=1e6 -N 1)
    run render "${bright[@]}" -o a.exr
    expect_match 'what a half does not hold is told' "$status: $output" \
        '0:*strata: warning: "a.exr": * beyond 65504, the largest half, * clipped to it, first (*--format float keeps it*'
    run render "${bright[@]}" --format float -o b.exr -o b.png
    expect_match 'floats hold it' "$status: ${output//warning/WARNED}" '0: wrote    b.exr*'
    expect 'without a warning' "$(grep -c warning <<<"$output")" 0
    run render "${bright[@]}" --quiet -o a.exr
    expect 'quietly nothing is said' "$status: $output" '0: '
    run animate "${bright[@]}" --frames 3-4 -o f.exr
    expect 'frames are told one by one' "$status: $(grep -c 'warning: "f.000[34].exr": ' <<<"$output")" '0: 2'
}

check_what_exr_says() {
    "$strata" render terrain --size 4x2 -N 1 --quiet -o still.exr
    "$strata" animate planet --size 4x2 -N 1 --fps 24000/1001 --frames 2 --quiet -o f.exr
    "$strata" animate planet --size 4x2 -N 1 --fps 12.5 --frames 2 --quiet -o g.exr
    local file
    for file in still f.0002 g.0002; do
        expect "an EXR names its primaries ($file)" "$(grep -ac chromaticities $file.exr)" 1
    done
    expect 'a still has no frame rate' "$(grep -ac framesPerSecond still.exr)" 0
    # Behind the name, the type, their ends and the size.
    rate() { tail -c "+$(($(LC_ALL=C grep -aobF framesPerSecond "$1" | cut -d: -f1) + 30))" "$1" | head -c 8 | od -An -tu4; }
    expect 'a frame says its rate' "$(rate f.0002.exr)" "$(printf ' %10d %10d' 24000 1001)"
    expect 'a decimal is the fraction it means' "$(rate g.0002.exr)" "$(printf ' %10d %10d' 25 2)"
}

check_text() {
    local title='Höhenzug – 山の上'
    "$strata" scenes constant | sed "s/^title = .*/title = \"$title\"/" >scene.toml
    run render scene.toml --size 4x2 -o a.png
    expect_match 'a scene with such a title is rendered' "$status: $output" '0: wrote    a.png*'
    expect 'its title is in a text of UTF-8' "$(LC_ALL=C grep -ac 'iTXtstrata:scene' a.png)" 1
    expect 'the digest is in a plain one' "$(LC_ALL=C grep -ac 'tEXtstrata:digest' a.png)" 1
    "$strata" render a.png --quiet -o b.png
    expect_same_file 'the picture renders itself again' a.png b.png
    run strip a.png b.png --reference 1 --rmse --title "$title" -o s.png
    expect 'and is shown' "$status: $output" '0: wrote    s.png'
    run animate scene.toml --size 4x2 --frames 1-2 -o f.png
    run animate scene.toml --size 4x2 --frames 1-2 -o f.png
    expect_match 'its frames are known again' "$status: $output" '0: frames   0 rendered, 2 kept*'
}

check_one_message() {
    "$strata" render constant --size 16x16 --quiet -o a.png -o a.tif -o a.jpg -o a.exr
    local extension command
    for extension in png tif jpg exr; do
        head -c 150 a.$extension >cut.$extension
        for command in render strip; do
            run $command cut.$extension
            expect_match "$command says one line of a cut .$extension" "$status: $output" '2: strata: *'
            expect 'and no more' "$(grep -c . <<<"$output")" 1
        done
    done
}

run_groups check_floating_tiff check_not_finite check_clipping check_what_exr_says check_text check_one_message
