#!/usr/bin/env bash
# Renders that are killed, and go on from their journal to the same bits. PROGRAM PRELOAD [--many]: a sample, or every
# write and many random moments.
set -u

here=${BASH_SOURCE[0]%/*}
# shellcheck source=tests/tools/cli_checks.sh
. "$here/../tools/cli_checks.sh"
preload=$(readlink -f -- "${2:?usage: ${0##*/} PROGRAM PRELOAD [--many]}")
many=${3:+1}  # in arithmetic, too

# A journal is written all the time.
every=(--journal-every 1e-9)

# What is rendered, by name: options, and the files that come of it.
declare -A words files
declare_case() { # name files words...
    files[$1]=$2 words[$1]="${*:3}"
}
declare_case streamed 'a.exr b.png' hyperterrain --size 200x260 -N 2 --tile 16 -o a.exr -o b.png
declare_case formats 'a.tif b.jpg c.png' terrain --size 96x160 -N 1 --tile 8 -o a.tif -o b.jpg -o c.png
declare_case costs 'a.exr a.steps.png' terrain --size 96x160 -N 2 --aov steps,evals -o a.exr --format float
declare_case crop 'a.exr' planet --size 160x160 --crop 30,20,150,151 -N 2 --tiled --tile 32 -o a.exr
declare_case shared 'a.exr a.png' terrain --size 64x200 -N 2 --estimator shared -o a.exr -o a.png
declare_case passes 'a.exr a.png' terrain --size 64x80 -N 2 --passes 5 -o a.exr -o a.png
declare_case weighted 'a.exr' terrain --size 64x80 -N 2 --estimator shared --passes 4 -o a.exr --format float
declare_case target 'a.exr' terrain --size 64x80 -N 2 --target-rmse 0.01 --passes 40 -o a.exr

render() { # case more...
    local command=()
    read -r -a command <<<"${words[$1]}"
    "$strata" render "${command[@]}" --threads 2 "${@:2}" 2>&1 </dev/null
}

# The shell's own word about it is no message of the program.
killed_at_write() { # n case
    STRATA_TEST_FAULT=write:$1:KILL LD_PRELOAD=$preload render "$2" --quiet "${every[@]}"
} 2>/dev/null

expect_whole() { # sentence case
    local file
    for file in ${files[$2]}; do expect_same_file "$1: $file" "$file" "whole/$file"; done
    expect "$1: nothing else is left" "$(find . -maxdepth 1 -type f | grep -vE "^\./(log|$(tr ' ' '|' <<<"${files[$2]}")|a\.evals\.png)$")" ''
}

make_whole() { # case
    mkdir whole
    (cd whole && render "$1" --quiet --no-journal)
}

# Killed at its n-th write, for many n, and gone on with: once, and after being killed again.
check_writes() { # case
    local n output writes step resumed=0
    make_whole "$1"
    STRATA_TEST_FAULT_LOG=log LD_PRELOAD=$preload render "$1" --quiet "${every[@]}"
    expect_whole "$1 with a journal" "$1"
    expect_match "$1 writes a journal" "$(grep -c journal log)" '[1-9]*'
    writes=$(grep -c '^write ' log)
    step=$((many ? 1 : writes / 3 + 1))
    for ((n = 1; n <= writes; n += step)); do
        rm -f ./*.*
        killed_at_write "$n" "$1"
        killed_at_write $((n / 2 + 1)) "$1"
        output=$(render "$1" "${every[@]}")
        [[ $output != *resumed* ]] || resumed=$((resumed + 1))
        # A journal that had not begun tells no one of the hidden files.
        find . -maxdepth 1 -name '.strata-*' -delete
        expect_whole "$1 killed at write $n of $writes" "$1"
    done
    echo "$1: $writes writes, $resumed gone on with" >&2
    expect_match "$1 is resumed" "$resumed" '[1-9]*'
}

# Killed up to three times at random moments of the time that it takes, then left alone.
check_moments() { # case
    local i kill kills=0 resumed=0 output command=() took_ms start
    read -r -a command <<<"${words[$1]}"
    start=$(date +%s%3N)
    make_whole "$1"
    took_ms=$(($(date +%s%3N) - start))
    for ((i = 0; i < (many ? 40 : 3); ++i)); do
        rm -f ./*.*
        for ((kill = RANDOM % 3; kill >= 0; --kill)); do
            { timeout -s KILL "$(printf '%d.%03d' $((RANDOM % took_ms / 1000)) $((RANDOM % 1000)))" \
                "$strata" render "${command[@]}" --quiet "${every[@]}" || kills=$((kills + 1)); } 2>/dev/null
        done
        output=$(render "$1" "${every[@]}")
        [[ $output != *resumed* ]] || resumed=$((resumed + 1))
        find . -maxdepth 1 -name '.strata-*' -delete
        expect_whole "$1 killed at random" "$1"
    done
    echo "$1: $kills kills at random, $resumed of $i gone on with" >&2
}

# Of the journal a power cut leaves what was synchronised, and of what was written since nothing, a part, or zeros; of
# hidden files it may leave anything, which is worth nothing.
cut_power() { # log journal
    local synced size
    find . -maxdepth 1 -name '.strata-*' -delete
    synced=$(sed -n 's|^synced \([0-9]*\) .*[.]journal\(.new\)*$|\1|p' "$1" | tail -n 1)
    [[ -e $2 ]] || return 0
    [[ $synced ]] || { rm "$2" && return; }
    size=$(stat -c %s "$2")
    truncate -s $((synced + RANDOM % (size - synced + 1))) "$2"
    ((RANDOM % 2)) || truncate -s "$size" "$2"
}

# Power is cut at the n-th write, for many n, once and, while it is gone on with, again.
check_power() { # case
    local n writes step resumed=0 output
    make_whole "$1"
    STRATA_TEST_FAULT_LOG=log LD_PRELOAD=$preload render "$1" --quiet "${every[@]}"
    writes=$(grep -c '^write ' log)
    expect_match "$1 synchronises its journal" "$(grep -c '^synced .*journal' log)" '[1-9]*'
    step=$((many ? 1 : writes / 3 + 1))
    for ((n = 1; n <= writes; n += step)); do
        rm -f ./*.* log
        STRATA_TEST_FAULT_LOG=log killed_at_write "$n" "$1"
        cut_power log a.exr.journal
        STRATA_TEST_FAULT_LOG=log killed_at_write $((n / 2 + 1)) "$1"
        cut_power log a.exr.journal
        output=$(render "$1" "${every[@]}")
        [[ $output != *resumed* ]] || resumed=$((resumed + 1))
        expect_whole "$1 whose power was cut at write $n of $writes" "$1"
    done
    echo "$1: $writes power cuts, $resumed gone on with" >&2
    expect_match "$1 is resumed after a power cut" "$resumed" '[1-9]*'
}

check_power_streamed() { check_power streamed; }
check_power_passes() { check_power passes; }
check_writes_streamed() { check_writes streamed; }
check_writes_formats() { check_writes formats; }
check_writes_costs() { check_writes costs; }
check_writes_crop() { check_writes crop; }
check_writes_shared() { check_writes shared; }
check_writes_passes() { check_writes passes; }
check_writes_weighted() { check_writes weighted; }
check_writes_target() { check_writes target; }
check_moments_streamed() { check_moments streamed; }
check_moments_passes() { check_moments passes; }

# Leaves a journal of a render that was killed. The last write is that of the picture's end.
leave_journal() { # case
    local n
    for n in 30 20 12 8; do
        killed_at_write $n "$1"
        find . -maxdepth 1 -name '.strata-*' -delete
        ! ls ./*.journal >/dev/null 2>&1 || return 0
    done
    expect "$1 leaves a journal" no yes
}

check_others() {
    leave_journal streamed
    local journal=a.exr.journal before
    before=$(cksum <$journal)
    refuses 'other samples are told' 2 "*another render*sampling.N: 2 there, 3 here*--restart*" \
        render hyperterrain --size 200x260 -N 3 --tile 16 -o a.exr -o b.png
    refuses 'other outputs are told' 2 "*outputs: halves of an EXR, codes of PNG or JPEG there, halves of an EXR here*" \
        render hyperterrain --size 200x260 -N 2 -o a.exr
    refuses 'another SIMD target is told' 2 "*simd_target: *" \
        render hyperterrain --size 200x260 -N 2 -o a.exr -o b.png --simd scalar
    expect 'a refusal leaves the journal' "$(cksum <$journal)" "$before"
    run render hyperterrain --size 20x26 -N 1 -o a.exr --no-journal
    expect_match 'without a journal nothing is asked' "$status" 0
    expect 'and the journal stays' "$(cksum <$journal)" "$before"
    run render hyperterrain --size 20x26 -N 1 -o a.exr --restart
    expect_match '--restart begins anew' "$status $(ls ./*.journal 2>&1)" '0 *No such file*'
    echo 'a letter' >$journal
    run render hyperterrain --size 20x26 -N 1 -o a.exr
    expect_match 'a file of that name that is no journal stays' "$status $(<$journal)" '0 a letter'
}

# Bits that were flipped and ends that were cut cost time, and no more.
check_damage() {
    local i size at
    make_whole streamed
    leave_journal streamed
    cp a.exr.journal kept
    size=$(stat -c %s kept)
    for ((i = 0; i < (many ? 60 : 6); ++i)); do
        cp kept a.exr.journal
        at=$((RANDOM * 32768 + RANDOM))
        if ((i % 2)); then
            truncate -s $((at % size)) a.exr.journal
        else
            printf '\x55' | dd of=a.exr.journal bs=1 seek=$((16 + at % (size - 16))) conv=notrunc status=none
        fi
        render streamed --quiet
        expect_same_file 'a damaged journal gives the same picture' a.exr whole/a.exr
        expect_same_file 'and the same other picture' b.png whole/b.png
        rm -f a.exr b.png
    done
}

# A signal stops the render; what is finished stays, and the picture is that of one that went through.
check_signals() {
    local signal pid
    mkdir whole
    local command=("$strata" render hyperterrain --size 320x180 -N 8 --tile 16 -o a.exr)
    (cd whole && "${command[@]}" --quiet)
    for signal in TERM HUP; do
        rm -f ./*.*
        env --default-signal=HUP "${command[@]}" "${every[@]}" >out 2>&1 &
        pid=$!
        await 'a journal is begun' 60 test -s a.exr.journal
        kill "-$signal" "$pid"
        await_end "SIG$signal ends the render" "$pid"
        expect_match "after SIG$signal the journal is told" "$(<out)" '*a.exr.journal keeps what is finished*'
        expect "SIG$signal leaves nothing hidden" "$(find . -name '.strata*')" ''
        output=$("${command[@]}" 2>&1)
        expect_match "after SIG$signal the render is gone on with" "$output" '*resumed*'
        expect_same_file "and gives the same picture" a.exr whole/a.exr
        expect 'and the journal goes' "$(ls ./*.journal 2>/dev/null)" ''
    done
    rm -f ./*.*
    "${command[@]}" --quiet
    expect 'a render that takes less than a sixth of the interval leaves nothing else' \
        "$(find . -mindepth 1 -maxdepth 1 -name '[.a]*')" ./a.exr
}

# A journal that cannot be made does not keep the picture from being made.
check_no_place() {
    make_whole streamed
    mkdir a.exr.journal
    output=$(render streamed "${every[@]}")
    expect_same_file 'a journal that cannot be begun costs no picture' a.exr whole/a.exr
    expect_match 'and is told' "$output" '*Is a directory*goes on without a journal*'
}

check_in_use() {
    "${interruptible[@]}" "$strata" render hyperterrain --size 320x180 -N 32 -o a.exr "${every[@]}" --quiet &
    local pid=$!
    await 'a journal is begun' 60 test -s a.exr.journal
    refuses 'a picture that another process renders is left to it' 2 '*another process*' \
        render hyperterrain --size 320x180 -N 32 -o a.exr
    kill -KILL "$pid"
    wait "$pid"
}

groups=(check_power_streamed check_writes_streamed check_writes_passes check_moments_streamed check_others check_damage check_signals check_in_use check_no_place
    check_writes_shared check_writes_costs)
[[ ! $many ]] || groups+=(check_writes_formats check_writes_crop check_writes_weighted check_writes_target check_moments_passes check_power_passes)
run_groups "${groups[@]}"
