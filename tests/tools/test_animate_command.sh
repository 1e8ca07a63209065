#!/usr/bin/env bash
# What `strata animate` promises, shown with tiny frames.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 16x9 -N 2)
has_ffmpeg=$(command -v ffmpeg)

check_frames() {
    run animate planet "${tiny[@]}" --frames 2-4 -o p.exr -o 'q_##.png'
    expect_match 'frames are rendered and counted' "$status: $output" '0: frames   3 rendered, 0 kept*wrote    p.####.exr*'
    expect 'files are named by frame' "$(echo *)" 'p.0002.exr p.0003.exr p.0004.exr q_02.png q_03.png q_04.png'
    "$strata" render planet "${tiny[@]}" --frame 3 -o r.exr -o r.png --quiet
    expect_same_file 'a frame is the picture that render makes' p.0003.exr r.exr
    expect_same_file 'in each format' q_03.png r.png
    expect 'frames differ' "$(cmp -s p.0002.exr p.0003.exr && echo same)" ''

    local before
    before=$(stat -c %Y.%i -- *.exr)
    run animate planet "${tiny[@]}" --frames 2-4 -o p.exr -o 'q_##.png'
    expect_match 'frames that are there are kept' "$status: $output" '0: frames   0 rendered, 3 kept*'
    expect 'and not written again' "$(stat -c %Y.%i -- *.exr)" "$before"
    rm p.0003.exr
    run animate planet "${tiny[@]}" --frames 1-4 -o p.exr --threads 1
    expect_match 'what is missing is rendered' "$status: $output" '0: frames   2 rendered, 2 kept*'
    expect_same_file 'to the same bits' p.0003.exr r.exr
    run animate planet "${tiny[@]}" --frames 2 -o p.exr --overwrite
    expect_match '--overwrite renders again' "$status: $output" '0: frames   1 rendered, 0 kept*'
}

check_other_frames() {
    "$strata" animate planet "${tiny[@]}" --frames 1-2 -o p.exr -o p.png --quiet
    refuses 'frames of other settings are refused with what differs' 2 \
        "*p.0001.exr is there and is not the frame asked for*'N = 2', not 'N = 3'*--overwrite*" \
        animate planet --size 16x9 -N 3 --frames 0-2 -o p.exr
    expect 'before anything is rendered' "$(echo *)" 'p.0001.exr p.0001.png p.0002.exr p.0002.png'
    echo text >p.0001.png
    refuses 'a file that is no picture is refused' 2 '*p.0001.png*no picture*' animate planet "${tiny[@]}" --frames 1 -o p.png
    run animate planet "${tiny[@]}" --frames 1-2 -o p.png --overwrite
    expect_match 'and replaced by --overwrite' "$status: $output" '0: frames   2 rendered*'
}

# One byte near the end of a file, or in its middle, becomes another.
damage() { # file offset
    local byte
    byte=$(od -An -tu1 -j "$2" -N 1 "$1")
    printf '%b' "\\x$(printf %02x $((byte ^ 16)))" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}

check_damaged_frames() {
    local frames=(animate planet "${tiny[@]}" --frames 0-3) extension size
    for extension in exr png tif jpg; do
        run "${frames[@]}" -o "whole.$extension" -o "p.$extension"
        : >"p.0000.$extension"
        size=$(stat -c %s "p.0001.$extension")
        truncate -s $((size - 5)) "p.0001.$extension"
        damage "p.0002.$extension" $((size * 3 / 4))
        run "${frames[@]}" -o "p.$extension"
        expect_match "an empty, a cut and a damaged .$extension are named and made again, the whole one is kept" \
            "$status: $output" "0: damaged  p.0000.$extension: it is empty; it is made again
damaged  p.0001.$extension: *; it is made again
damaged  p.0002.$extension: its bytes are not those that were written; it is made again
frames   3 rendered, 1 kept*"
        for frame in 0 1 2 3; do
            expect_same_file 'to the same bytes' "p.000$frame.$extension" "whole.000$frame.$extension"
        done
        damage "p.0002.$extension" $((size * 3 / 4))
        refuses "a damaged .$extension is not compared" 2 "*p.0002.$extension*it is damaged*" strip "p.0002.$extension" -o s.png
        damage "p.0001.$extension" $((size * 3 / 4))
        refuses "nor compared with" 2 "*p.0001.$extension*it is damaged*" sweep planet "${tiny[@]}" --seed 1,2 \
            --frame 1 --reference "p.0001.$extension" -o s
    done
    : >p.0000.png
    run "${frames[@]}" -o p.png --quiet
    expect '--quiet says nothing of it' "$status: $output" '0: '
}

check_refusals() {
    local range
    for range in 3-2 a -1 1-2-3 1.5 0-100000; do
        refuses "frames $range are refused" 2 "*--frames*" animate planet --frames="$range" -o p.png
    done
    refuses 'a scene without motion or keys needs frames' 2 '*--frames is needed*' animate terrain -o p.png
    refuses '--frame is not what is meant' 2 '*--frame: allowed: --frames*' animate planet --frame 3
    refuses 'an unknown extension is refused with the known ones' 2 '*.bmp*.exr*.mp4*' animate planet --frames 1 -o p.bmp
    refuses 'EXR holds no sheet' 2 '*p.exr*' animate wheel -o p.exr
    refuses 'a missing folder is named' 1 '*"nowhere" does not exist*' animate planet --frames 1 -o nowhere/p.png
    refuses 'settings of columns are checked' 2 "*--columns 'N=99': sampling.N: out of range*" animate wheel --columns 'N=99'
    refuses 'a misspelt setting gets the nearest' 2 "*did you mean 'none'*" animate wheel --columns 'nne; N=2'
    refuses 'columns of other sizes are refused' 2 '*same film.width*' animate wheel --columns 'none; film.width=3'
    refuses '--columns and --left are one too many' 2 '*--columns: allowed: without --left*' animate wheel --columns none --left none
    refuses 'an octave too fine at a late frame is refused by frame' 2 '*frame 1000000000*2^50*' \
        animate hyperterrain --frames 1000000000 --set 'surface.drift=[1e6,0,0]' -o p.png
    output=$(PATH=/nonexistent "$strata" animate wheel "${tiny[@]}" -o w.mp4 2>&1)
    expect_match 'without ffmpeg the package is named' "$?: $output" '1: *ffmpeg is not installed*package ffmpeg*'
    expect 'nothing is written when something is refused' "$(ls -A)" ''
}

check_columns() {
    run animate isosurface --size 32x24 -N 2 --frames 0-1 -o i.png
    expect_match 'the isosurface is compared by default' "$status: $output" '0: frames   2 rendered*'
    run animate isosurface --size 32x24 -N 2 --frames 0-1 -o i.png
    expect_match 'its frames are kept too' "$status: $output" '0: frames   0 rendered, 2 kept*'
    refuses 'but not as those of other columns' 2 '*strata:columns*' \
        animate isosurface --size 32x24 -N 2 --frames 0-1 --left 'N=1' -o i.png
    run animate isosurface --size 32x24 -N 2 --frames 0 --columns scene -o one.png
    local frame rays=()
    for frame in 0 125 60; do
        rays+=("$("$strata" probe ray isosurface --size 32x24 --frame "$frame" --pixel 16,8 |
            sed 's/.*"t":\([^,]\{8\}\).*/\1/')")
    done
    expect 'in the frame after the loop a ray hits where it hit in the first' "${rays[1]}" "${rays[0]}"
    expect 'and not so halfway' "$([[ ${rays[2]} == "${rays[0]}" ]] || echo differs)" differs
}

check_films() {
    [[ $has_ffmpeg ]] || return
    local name
    mkdir -p 'a#1 %d/50%'
    for name in 'a#1 %d/50%/Größe #2 %03d.MP4' './-dash.WebM' "it's [a]{b}*?.GIF" ':colon,;=.mp4'; do
        run animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o "$name"
        expect "'$name' is a film's name" "$status: $output $(ffprobe -v error -count_frames -show_entries \
            stream=nb_read_frames -of csv=p=0 "file:$name" 2>&1 | head -c 1)" '0:  2'
        run animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o "$name.FRAMES #.PNG" -o "$name"
        expect "frames may be called '$name.FRAMES #.PNG'" "$status: $output" '0: '
        rm -- "${name%.*}"*
    done
    rm -r 'a#1 %d'
    run animate wheel --size 16x16 -N 2 --frames 0-4 -o 'w x.mp4' -o w.webm -o w.gif
    expect_match 'films are encoded' "$status: $output" '0: frames   5 rendered*wrote    w x.mp4 (5 frames, 0.2 s)*w.gif*'
    expect 'their frames are gone' "$(find . -mindepth 1 | sort | tr '\n' ' ')" './w x.mp4 ./w.gif ./w.webm '
    cp 'w x.mp4' earlier.mp4
    cp w.gif earlier.gif
    run animate wheel --size 16x16 -N 2 --frames 0-4 -o 'w x.mp4' -o w.gif -o 50%.png --threads 1
    expect_same_file 'equal frames are equal films' earlier.mp4 'w x.mp4'
    expect_same_file 'and equal gifs' earlier.gif w.gif
    expect 'frames asked for stay' "$(echo 50*)" '50%.0000.png 50%.0001.png 50%.0002.png 50%.0003.png 50%.0004.png'
    local facts
    facts=$(ffprobe -v error -count_frames -show_entries stream=codec_name,width,height,pix_fmt,color_space,nb_read_frames,r_frame_rate \
        -of csv=p=0 'w x.mp4')
    expect_match 'H.264, even sides, 4:2:0, BT.709, 25 frames/s, every frame' "$facts" 'h264,*[02468],*[02468],yuv420p,bt709,25/1,5'
    expect 'a gif has every frame' "$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 w.gif)" 5
    mkdir fake
    printf '#!/bin/sh\necho no room >&2\nexit 3\n' >fake/ffmpeg
    chmod +x fake/ffmpeg
    output=$(PATH="$PWD/fake:$PATH" "$strata" animate wheel --size 16x16 -N 2 --frames 0-4 -o w.gif 2>&1)
    expect_match "an encoder that fails says why" "$?: $output" '1: *ffmpeg: failed with code 3*no room*'
    expect_same_file 'the earlier film stays' earlier.gif w.gif
    expect 'and the frames are kept for another try' "$(find w.gif.frames -name '*.png' | wc -l)" 5
}

duration() { # film: what its container says, in seconds
    ffprobe -v error -show_entries format=duration -of csv=p=0 "$1"
}

# The red, green and blue of a film's pixel in its first frame.
pixel() { # film x y
    ffmpeg -v error -i "$1" -frames:v 1 -vf "format=rgb24,crop=1:1:$2:$3" -f rawvideo - | od -An -tu1
}

check_film_times() {
    [[ $has_ffmpeg ]] || return
    run animate wheel --size 16x16 -N 1 --frames 0-29 --fps 60 --columns scene -o w.gif -o w.mp4 -o w.webm
    expect_match 'a GIF leaves out frames that come too fast, and says so' "$status: $output" \
        '0: *w.gif (15 of 30 frames, 0.5 s: a GIF shows up to 50 a second)*w.mp4 (30 frames, 0.5 s)*'
    local film
    for film in w.gif w.mp4 w.webm; do
        expect_match "$film plays half a second" "$(duration "$film")" '0.50*'
    done
    expect 'no delay of the GIF is below 2/100 s' \
        "$(ffprobe -v error -show_entries packet=duration_time -of csv=p=0 w.gif | tr -d ',' | awk '$1 < 0.0199' | wc -l)" 0

    run animate wheel --size 16x16 -N 1 --frames 0-23 --fps 24000/1001 --columns scene -o r.mp4 -o r.gif -o r.webm
    expect_match 'a fraction is a rate' "$status: $output" '0: *r.mp4 (24 frames, 1.001 s)*'
    expect 'which the film has exactly' \
        "$(ffprobe -v error -show_entries stream=r_frame_rate -of csv=p=0 r.mp4)" 24000/1001
    for film in r.mp4 r.webm r.gif; do expect_match "$film plays 1.001 s" "$(duration "$film")" '1.00*'; done

    run animate wheel --size 16x16 -N 1 --frames 0-20x2 --columns scene -o s.mp4 -o 's.##.png'
    expect_match 'every second frame' "$status: $output" '0: frames   11 rendered*s.mp4 (11 frames, 0.88 s)*'
    expect 'is rendered alone' "$(echo s.*.png)" 's.00.png s.02.png s.04.png s.06.png s.08.png s.10.png s.12.png s.14.png s.16.png s.18.png s.20.png'
    expect_match 'and plays as fast as all would' "$(duration s.mp4)" '0.88*'
    run animate wheel --size 16x16 -N 1 --frames 7-8,0,2 --columns scene -o 'l.#.png'
    expect 'a list of frames' "$status $(echo l.*)" '0 l.0.png l.2.png l.7.png l.8.png'
    refuses 'a film of unevenly spread frames is refused' 2 '*would not play in time*' \
        animate wheel --frames 7-8,0,2 --columns scene -o l.mp4
    refuses 'a GIF too slow for its file is refused' 2 '*allowed in a GIF*' animate wheel --frames 0-1 --fps 0.001 -o l.gif
}

# A grey frame: a border of another colour would show.
check_odd_sides() {
    [[ $has_ffmpeg ]] || return
    local film
    run animate constant --size 31x17 -N 1 --frames 0-1 -o c.mp4 -o c.webm
    for film in c.mp4 c.webm; do
        expect_match "$film has even sides" \
            "$status $(ffprobe -v error -show_entries stream=width,height -of csv=p=0 "$film")" '0 32,18'
        local size
        size=$(ffprobe -v error -show_entries stream=width,height -of csv=p=0 "$film")
        expect_match "a pixel of $film can be read" "$(pixel "$film" 2 2)" '*[0-9]*'
        expect "the edge of $film repeats, to the corner" \
            "$(pixel "$film" $((${size%,*} - 1)) $((${size#*,} - 1)))" "$(pixel "$film" $((${size%,*} - 2)) $((${size#*,} - 2)))"
    done
}

check_signals() {
    "${interruptible[@]}" "$strata" animate hyperterrain --size 160x90 -N 8 --frames 0-999 --quiet -o h.png &
    local pid=$! i
    for ((i = 0; i < 1500; ++i)); do
        [[ -e h.0001.png ]] && break
        sleep 0.02
    done
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends an animation with 130' "$?" 130
    local broken=0 file
    for file in h.*.png; do
        "$strata" render "$file" --size 4x4 -N 1 --quiet -o t.exr || broken=1
    done
    expect 'whole frames are left, and nothing else' "$broken $(find . -mindepth 1 | grep -vc '^./h\.[0-9]*\.png$\|^./t.exr$')" '0 0'
}

run_groups check_frames check_other_frames check_damaged_frames check_refusals check_columns check_films check_film_times \
    check_odd_sides check_signals
