#!/usr/bin/env bash
# What is promised of every file that a command writes: it is placed as its owner wants it, or kept and its place told.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 32x18 -N 1 --quiet)

# All names in this folder, hidden ones too, sorted.
entries() { find . -mindepth 1 -maxdepth 1 -printf '%P\n' | LC_ALL=C sort | paste -sd ' '; }

mode() { stat -c %a -- "$@" | tr '\n' ' '; }

# Until a command that runs has begun so many files in the folder. Each is tried before, alone.
await_hidden() { # folder count
    local i
    for ((i = 0; i < 3000; ++i)); do
        (($(compgen -G "$1/.strata-*" | wc -l) >= $2)) && return
        sleep 0.01
    done
}

check_last_step_of_passes() {
    mkdir out temporary
    TMPDIR=$PWD/temporary "$strata" render edge "${tiny[@]}" --time-limit 3s -o a.exr -o out/b.png --stats s.json 2>messages &
    local pid=$!
    await_hidden out 1
    sleep 1
    rm -rf out
    wait "$pid"
    expect 'a folder that goes while passes are rendered is an error' $? 1
    expect_match 'of the one picture in it, which is kept in TMPDIR, as is said' "$(cat messages)" \
        "strata: cannot write \"out/b.png\": *; the whole file is \"$PWD/temporary/b.kept.png\""
    expect 'the other picture and the statistics are there, nothing else' "$(find . -type f ! -name messages | sort | tr '\n' ' ')" \
        './a.exr ./s.json ./temporary/b.kept.png '
    run render temporary/b.kept.png --quiet -o again.png
    expect_same_file 'what was kept is the whole picture' again.png temporary/b.kept.png
}

check_folder_in_the_way() {
    local options
    for options in '-N 16' '-N 4 --time-limit 4s'; do
        mkdir work
        # shellcheck disable=SC2086 # two words
        (cd work && exec "$strata" render hyperterrain --size 160x90 --quiet --no-journal $options -o a.exr -o a.png --stats s.json 2>messages) &
        local pid=$!
        await_hidden work 3
        mkdir work/a.png work/s.json
        wait "$pid"
        expect "a target that became a folder is an error ($options)" $? 1
        expect_match 'the whole files lie beside it, and that is said' "$(sort work/messages)" \
            '*"a.png": Is a directory; the whole file is "./a.kept.png"*"s.json": Is a directory; the whole file is "./s.kept.json"'
        expect 'nothing else is there' "$(cd work && entries) " 'a.exr a.kept.png a.png messages s.json s.kept.json '
        run render work/a.kept.png -o again.png --quiet
        expect_same_file 'what was kept is whole' again.png work/a.kept.png
        rm -rf work
    done
}

check_reports_fail_alone() {
    mkdir d
    "$strata" stability --fast --only sums -o d --json s.json --quiet 2>messages &
    local pid=$!
    await_hidden d 2
    mkdir d/stability.md
    wait "$pid"
    expect 'a report that cannot be placed is an error' $? 1
    expect_match 'that names where it is' "$(cat messages)" '*"d/stability.md": Is a directory; the whole file is "d/stability.kept.md"'
    expect_same_file 'the others are there' d/stability.json s.json

    mkdir c
    "$strata" converge edge --size 48x48 --N 8 --m 1 --estimators random --seeds 200 -o c --quiet 2>messages &
    pid=$!
    await_hidden c 7
    mkdir c/converge.csv c/error-time.svg
    wait "$pid"
    expect 'so it is of a measurement' $? 1
    expect 'all others of which are there' "$(cd c && entries) " \
        'converge.csv converge.json converge.kept.csv error-samples.png error-samples.svg error-time.kept.svg error-time.png error-time.svg summary.md '
}

check_mounted_file() {
    "$strata" render edge "${tiny[@]}" -o expected.png --stats s.json || return
    touch a.png inside
    # shellcheck disable=SC2016 # for the inner shell
    unshare -m bash -c 'mount --bind inside a.png' 2>/dev/null || return 0 # mounts are not permitted here
    # shellcheck disable=SC2016
    output=$(unshare -m bash -c 'mount --bind inside a.png && "$1" render edge --size 32x18 -N 1 --quiet -o a.png' - "$strata" 2>&1)
    expect 'a mounted file takes a picture' "$?: $output" '0: '
    expect_same_file 'whole, in its place' inside expected.png
    expect 'and nothing is left' "$(entries) " 'a.png expected.png inside s.json '
}

# Everything that is written in the end, each by a command.
write_all() {
    "$strata" render edge "${tiny[@]}" -o p.exr -o p.png -o p.tif -o p.jpg --aov steps --stats p.json &&
        "$strata" render edge "${tiny[@]}" --passes 2 -o passes.exr &&
        "$strata" animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o w.mp4 -o w.gif -o w.png &&
        "$strata" strip --scene edge --size 32x18 --columns 'none; N=2' --parts --quiet -o t.png &&
        "$strata" explain edge --size 32x18 --no-pilot --quiet --json e.json &&
        "$strata" sweep edge --size 16x9 --N 1,2 -o w --quiet &&
        "$strata" stability --fast --only sums -o w --quiet --json y.json &&
        "$strata" converge edge --size 8x8 --N 1,2 --m 1 --estimators random --seeds 2 -o w --quiet &&
        "$strata" figures --only 3 --size small -o w --quiet
}

check_what_owners_set() {
    umask 022
    write_all
    expect 'all commands write' $? 0
    local files
    mapfile -t files < <(find . -type f ! -name '*.json' | sort)
    mapfile -t -O "${#files[@]}" files < <(find . -type f -name '*.json' | sort)
    expect_match 'there is much to look at' "${#files[@]}" '[34]?'
    expect 'new files are as the umask says' "$(mode "${files[@]}" | tr ' ' '\n' | sort -u | xargs)" 644
    chmod 640 -- "${files[@]}"
    # What is kept as it is would show nothing.
    rm -f w/*.exr w.0*.png
    local before now file
    before=$(stat -c '%n %i' -- "${files[@]}" 2>/dev/null)
    write_all
    for file in "${files[@]}"; do
        [[ $file == ./w/*.exr || $file == ./w.0*.png ]] && continue
        expect "$file keeps its mode" "$(mode "$file")" '640 '
    done
    now=$(stat -c '%n %i' -- "${files[@]}")
    expect_match 'and most were replaced, not left' "$(comm -13 <(sort <<<"$before") <(sort <<<"$now") | wc -l)" '[23]?'
}

check_dangling_links() {
    mkdir real w real/w
    local file
    for file in p.exr p.png p.steps.png p.json passes.exr w.mp4 w.gif w.0000.png t.png t-1.exr e.json y.json w/sweep.csv \
        w/sweep.json w/sweep.png w/N01.exr w/stability.md w/converge.csv w/error-time.png w/figure-3.png w/figure-3.json; do
        ln -s "$PWD/real/$file" "$file"
    done
    write_all
    expect 'dangling links are followed' $? 0
    for file in p.exr p.png p.steps.png p.json passes.exr w.mp4 w.gif w.0000.png t.png t-1.exr e.json y.json w/sweep.csv \
        w/sweep.json w/sweep.png w/N01.exr w/stability.md w/converge.csv w/error-time.png w/figure-3.png w/figure-3.json; do
        expect "$file stays a link and its file is made" "$([[ -L $file && -s real/$file ]] && echo yes)" yes
    done
}

check_limits() {
    "$strata" scenes terrain | grep -v '^keys' >long.toml
    local i
    for ((i = 0; i < 1500; ++i)); do
        printf '[[camera.keys]]\ntime_s = %d\nposition = [0.123456789, %d.5, 7.25]\nlook_at = [0, 1, 0]\n' "$i" "$i"
    done >>long.toml
    local options
    for options in '' '--passes 3'; do
        # shellcheck disable=SC2086 # two words
        refuses "metadata that a format does not hold are found first ($options)" 2 '*"a.tif": * bytes of metadata do not fit*' \
            render long.toml --size 32x18 -N 1 $options -o a.exr -o a.tif --stats s.json
        expect 'and nothing is made' "$(entries)" long.toml
    done
    refuses 'of frames too' 2 '*a.*.jpg*bytes of metadata do not fit*' animate long.toml --size 32x18 -N 1 --frames 0-1 -o a.jpg
    refuses 'of a strip too' 2 '*bytes of metadata do not fit*' strip --scene long.toml --size 32x18 --columns none -o a.jpg
    refuses 'a strip too large for JPEG is found first' 2 '*65500*' \
        strip --scene edge --size 2000x20 --columns "$(printf 'none;%.0s' {1..40})none" --zoom 1 -o a.jpg
    expect 'and nothing is made' "$(entries)" long.toml

    # An EXR of another program, its frame made smaller than its pixels.
    ffmpeg -v error -f lavfi -i color=red:s=16x16 -frames:v 1 over.exr </dev/null || return 0
    local at
    at=$(($(LC_ALL=C grep -obUa -m 1 displayWindow over.exr | head -n 1 | cut -d : -f 1) + 14 + 6 + 4))
    printf '\4\0\0\0\4\0\0\0\12\0\0\0\12\0\0\0' | dd of=over.exr bs=1 seek="$at" conv=notrunc status=none
    refuses 'an overscan picture is no part, which is found first' 2 '*--parts: over.exr: *outside*allowed*' strip over.exr --parts -o s.png
    run strip over.exr --quiet -o s.png
    expect 'without parts it can be shown' "$status: $output" '0: '
}

check_one_file() {
    refuses 'statistics do not go where a false-colour picture goes' 2 '*--stats a.steps.png: allowed: a file of its own; --aov steps*' \
        render edge --stats a.steps.png --aov steps -o a.exr
    refuses 'nor where a picture goes' 2 '*--stats z.png: allowed: a file of its own*' render edge --stats z.png -o z.png
    refuses 'by another spelling' 2 '*--stats ./z.png: allowed: a file of its own*' render edge --stats ./z.png -o z.png
    ln -s z.png link
    refuses 'through a link to a file that is not there yet' 2 '*--stats link: allowed: a file of its own*' render edge --stats link -o z.png
    mkdir d && ln -s d e
    refuses 'through a folder that is a link' 2 '*--stats e/z.png: allowed: a file of its own*' render edge --stats e/z.png -o d/z.png
    refuses 'reports are files of their own' 2 '*s/stability.json: allowed: a file of its own*' stability --fast -o s --json s/stability.json
    refuses 'frames too' 2 '*some frames of another -o are the same*' animate wheel --frames 8-10 --columns scene -o 'f.#.png' -o 'f.##.png'
    rm -rf s
    expect 'and nothing is made' "$(entries) " 'd e link '
    run render edge "${tiny[@]}" -o b.exr -o ./b.exr -o e/b.exr -o d/b.exr -o b.partial.exr
    expect 'one picture asked for twice is made once, whatever it is called' "$status: $output $(find . -name '*b*.exr' | sort | xargs)" \
        '0:  ./b.exr ./b.partial.exr ./d/b.exr'
}

check_names() {
    local long
    long=$(printf 'n%.0s' {1..251})
    run render edge "${tiny[@]}" --aov steps -o "$long.exr" -o "$long.PNG" --stats "$(printf 's%.0s' {1..255})"
    expect 'names of 255 bytes are names, and those made of them fit' "$status: $output $(entries | wc -w)" '0:  4'
    run strip --scene edge --size 32x18 --columns none --parts --quiet -o "$long.png"
    expect 'of strips too' "$status: $output $(entries | wc -w)" '0:  6'
    run animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o "$long.mp4" -o "$long.GIF"
    expect 'of films too' "$status: $output $(entries | wc -w)" '0:  8'
    run animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o "$long.jpg"
    expect 'of frames too' "$status: $output $(entries | wc -w)" '0:  10'
    "$strata" scenes edge >'A #1 100%.TOML'
    run render 'A #1 100%.TOML' "${tiny[@]}"
    expect 'scenes are called as one likes' "$status: $output $(echo A*)" '0:  A #1 100%.TOML A #1 100%.exr A #1 100%.png'
    for name in '#%d ?*.MP4' 'a%b#.Webm' '100%.GIF'; do
        run animate wheel --size 16x16 -N 1 --frames 0-1 --quiet -o "$name"
        expect "'$name' is a film" "$status: $output $(find . -name "*.frames" | wc -l)" '0:  0'
    done
    refuses 'an extension means the same in capitals' 2 '*allowed in a GIF*' animate wheel --frames 0-1 --fps 0.001 -o l.GIF
    refuses 'and of WebM' 2 '*allowed in WebM*' animate wheel --frames 0-1 --fps 1000 -o l.WEBM
}

check_partial_of_long_names() {
    local long
    long=$(printf 'n%.0s' {1..251})
    "${interruptible[@]}" "$strata" render hyperterrain --size 640x360 -N 16 --quiet --no-journal -o "$long.exr" -o a.exr -o a.partial.exr &
    local pid=$!
    await_handler "$pid"
    await_hidden . 3
    kill -INT "$pid"
    wait "$pid"
    expect 'an interrupted render ends with 130' $? 130
    expect_match 'what was finished has names that fit, none of them one that was asked for' "$(entries)" \
        'a.partial-2.exr a.partial.partial.exr nnn*~????????.partial.exr'
}

check_two_writers() {
    # What stands in for ffmpeg tells how its file is called.
    mkdir fake
    # shellcheck disable=SC2016 # for another shell
    printf '#!/bin/sh\nfor word; do :; done\necho "$word" >>%q\nexec /usr/bin/ffmpeg "$@"\n' "$PWD/names" >fake/ffmpeg
    chmod +x fake/ffmpeg
    local film=(animate wheel --size 64x64 --frames 0-30 --columns scene --quiet)
    "$strata" "${film[@]}" -N 1 -o one.mp4
    "$strata" "${film[@]}" -N 2 -o two.mp4
    PATH="$PWD/fake:$PATH" "$strata" "${film[@]}" -N 1 -o w.mp4 &
    local first=$!
    PATH="$PWD/fake:$PATH" "$strata" "${film[@]}" -N 2 -o w.mp4 &
    wait "$first"
    expect 'two runs that make one film do not meet: the first ends well' $? 0
    wait "$!"
    expect 'so does the second' $? 0
    expect 'the film is one of theirs' "$(cmp -s w.mp4 one.mp4 || cmp -s w.mp4 two.mp4 && echo yes)" yes
    expect 'nothing else is left' "$(entries)" 'fake names one.mp4 two.mp4 w.mp4'
    expect 'their hidden files have names of their own' "$(grep -cx 'file:\.\{0,1\}/\{0,1\}\.strata-[a-z0-5]\{12\}' names) $(sort -u names | wc -l)" '2 2'
}

run_groups check_last_step_of_passes check_folder_in_the_way check_reports_fail_alone check_mounted_file check_what_owners_set \
    check_dangling_links check_limits check_one_file check_names check_partial_of_long_names check_two_writers
