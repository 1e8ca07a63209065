#!/usr/bin/env bash
# Parts of a picture, and the whole put together from them: the same file, byte for byte, that one render writes.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

# Renders a picture whole and in so many parts, puts these together and compares. The parts are made in another order
# and by other threads and tiles.
check_whole() { # count words...
    local number parts=()
    run render "${@:2}" --quiet -o whole.exr
    expect "$2 is rendered" "$status" 0
    for ((number = $1; number >= 1; --number)); do
        run render "${@:2}" --quiet --shard "$number/$1" --threads $((number % 3 + 1)) -o "part-$number.exr"
        expect "part $number of $1 is rendered" "$status: $output" '0: '
        parts+=("part-$number.exr")
    done
    run merge "${parts[@]}" --quiet -o together.exr
    expect "$1 parts of '${*:2}' are put together" "$status: $output" '0: '
    expect_same_file "$1 parts of '${*:2}' are the whole" together.exr whole.exr
}

check_stills() { check_whole 3 hyperterrain --size 200x170 -N 2; }
check_tiled() { check_whole 4 planet --size 260x130 -N 1 --tiled --format float; }
check_crop() { check_whole 2 terrain --size 320x200 --crop 33,20,290,151 -N 1; }
check_shared() { check_whole 3 terrain --size 130x70 -N 2 --estimator shared; }
check_passes() { check_whole 3 terrain --size 130x140 -N 2 --passes 3; }
check_channels() { check_whole 2 terrain --size 130x140 -N 1 --aov steps,evals; }
check_one() { check_whole 1 terrain --size 65x64 -N 1; }

check_refusals() {
    local words=(terrain --size 200x140 -N 1 --quiet) number
    for number in 1 2 3; do run render "${words[@]}" --shard $number/3 -o $number.exr; done
    refuses 'a part that is missing is named' 2 '*of 3 parts 1 is missing: part 2*' merge 1.exr 3.exr -o w.exr
    cp 2.exr copy.exr
    run merge 1.exr 2.exr 3.exr copy.exr --quiet -o w.exr
    expect 'the same part twice is taken once' "$status: $output" '0: '
    rm w.exr
    run render "${words[@]}" --seed 7 --shard 2/3 -o seed.exr
    refuses 'other settings are named' 2 '*1.exr and seed.exr*sampling.seed: * there, 7 here*' merge 1.exr seed.exr 3.exr -o w.exr
    run render "${words[@]}" --shard 2/4 -o four.exr
    refuses 'parts of another number are told' 2 '*shards: 3 there, 4 here*' merge 1.exr four.exr 3.exr -o w.exr
    run render "${words[@]}" --simd scalar --shard 2/3 -o scalar.exr
    refuses 'another SIMD target is told' 2 '*strata:simd_target: * there, scalar here*' merge 1.exr scalar.exr 3.exr -o w.exr
    run render "${words[@]}" -o plain.exr
    refuses 'a picture that is no part is told' 2 '*plain.exr: it is no part*' merge 1.exr plain.exr -o w.exr
    cp 2.exr damaged.exr
    printf '\x55\x55' | dd of=damaged.exr bs=1 seek=$(($(stat -c %s damaged.exr) - 40)) conv=notrunc status=none
    refuses 'a damaged part is told' 2 '*damaged.exr: it is damaged; render part 2/3 again*' merge 1.exr damaged.exr 3.exr -o w.exr
    refuses 'a part is not written over' 2 '*another file than the parts*' merge 1.exr 2.exr 3.exr -o 3.exr
    refuses 'a file that is not there is told' '[12]' '*none.exr*' merge 1.exr none.exr -o w.exr
    expect 'what is refused leaves nothing' "$(ls -A ./w.* .strata* 2>/dev/null)" ''
}

check_shard_words() {
    local text
    for text in 3 0/4 5/4 a/b 1/ 1/100000; do
        refuses "--shard $text is refused" 2 "*--shard*" render terrain --shard $text
    done
    refuses 'more shards than blocks are refused' 2 '*the picture has 4 blocks*' render terrain --size 128x128 --shard 1/5
    refuses 'parts are EXRs' 2 '*-o a.png: allowed with --shard: .exr*' render terrain --shard 1/2 -o a.png
    refuses 'a target is of the whole' 2 '*that of the whole picture*' render terrain --shard 1/2 --target-rmse 0.1
    run render terrain --size 128x128 -N 1 --shard 2/3 --quiet
    expect 'a part has a name of its own' "$(ls)" terrain.2-of-3.exr
}

run_groups check_stills check_tiled check_crop check_shared check_passes check_channels check_one check_refusals \
    check_shard_words
