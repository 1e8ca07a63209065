#!/usr/bin/env bash
# strata gallery: what it writes, what it keeps, what its pages say.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 48x27 -N 1 --simd scalar)

check_refusals() {
    refuses 'a scene alone is refused' 2 '*SCENE: allowed with --seeds or --scales*' gallery ridges
    refuses 'a key without numbers is refused' 2 '*--key: allowed with --seeds*' gallery --key surface.seed
    refuses 'an unknown scene of the gallery gets the nearest' 2 "*did you mean 'ridges'*" gallery --only rigdes
    refuses 'what is no landscape to hang is none of it' 2 '*wheel*' gallery --only wheel
    refuses 'numbers that end before they begin are refused' 2 '*--seeds 3-1: ends before it begins*' gallery hills --seeds 3-1
    refuses 'too many variants are refused' 2 '*401 variants, allowed: up to 400*' gallery hills --seeds 1-401
    refuses 'a key that is none is refused' 2 "*--key surface.sed, --seeds 1: *did you mean 'surface.seed'*" \
        gallery hills --seeds 1 --key surface.sed
    refuses 'all seeds at once are of a relief of terms' 2 '*relief.seed: the scene has no *relief*surface.seed*' \
        gallery hills --seeds 1 --key relief.seed
    refuses 'a place outside of the frame is refused' 2 '*--scales 0,0,513,2: allowed*' gallery hills --scales 0,0,513,2
    expect 'nothing was written' "$(ls -A)" ''
}

# Everything that a page shows or leads to lies beside it.
links_of() { grep -oE '(href|src)="[^"]*"' "$1" | sed 's/.*="\(.*\)"/\1/' | grep -v '^data:,$' | sort -u; }

check_gallery() {
    run gallery --only ridges,moon "${tiny[@]}" -o 'a folder/g'
    expect_match 'a gallery is made' "$status: $output" '0: *wrote *a folder/g: index.html, wall.jpg and 4 pictures*'
    cd 'a folder/g' || return
    expect 'of each scene there are two pictures' "$(echo *)" \
        'gallery.json index.html moon-small.jpg moon.jpg ridges-small.jpg ridges.jpg wall.jpg'
    expect 'the page leads to all of them' "$(links_of index.html | tr '\n' ' ')" \
        'moon-small.jpg moon.jpg ridges-small.jpg ridges.jpg '
    expect_match 'it says how long each took' "$(<index.html)" '*48 × 27 pixels, 1 samples each*N = 1), * s of processor time*'
    local command
    command=$(grep -o 'strata render ridges[^<]*' index.html)
    (mkdir again && cd again && eval "${command/#strata/\"$strata\"} --simd scalar --quiet")
    expect_same_file "the command of the page makes the picture: $command" again/ridges.jpg ridges.jpg
    rm -r again
    run render ridges.jpg --quiet -o again.jpg
    expect_same_file 'a picture makes itself again' again.jpg ridges.jpg
    cp index.html before.html
    run gallery --only ridges,moon "${tiny[@]}" -o . --threads 1
    expect_match 'what is there is kept' "$status: $output" '0: kept     all 4 pictures: nothing to render*'
    expect_same_file 'with its times' index.html before.html
    truncate -s -9 moon.jpg
    run gallery --only ridges,moon "${tiny[@]}" -o .
    expect_match 'what is damaged is made again' "$status: $output" '0: damaged  *moon.jpg*kept     3 pictures, 1 to render*'
    run gallery --only ridges,moon "${tiny[@]}" --exposure 2 -o .
    expect_match 'other settings make other pictures' "$status: $output" '0: *wrote *'
    expect_match 'which the page says' "$(<index.html)" '*strata render moon --size 48x27 -N 1 --exposure 2 -o moon.jpg*'
}

check_variants() {
    run gallery ridges --seeds 0,3-4 "${tiny[@]}" -o v --quiet
    expect 'variants are made' "$status: $output $(cd v && echo *)" "0:  ridges-relief.seed-0.jpg ridges-relief.seed-3.jpg \
ridges-relief.seed-4.jpg ridges-variants.html ridges-variants.jpg ridges-variants.json"
    "$strata" render ridges "${tiny[@]}" --set relief.seed=3 --quiet -o alone.jpg
    expect_same_file 'each is what its command makes' alone.jpg v/ridges-relief.seed-3.jpg
    expect 'which the page says' "$(grep -oc 'strata render ridges --size 48x27 -N 1 --set relief.seed=3' v/ridges-variants.html)" 1
    "$strata" render ridges "${tiny[@]}" --quiet -o plain.jpg
    expect_same_file 'the variant 0 is the scene' plain.jpg v/ridges-relief.seed-0.jpg
    expect 'and 3 is not' "$(cmp -s plain.jpg alone.jpg || echo other)" other
    run gallery planet --seeds 1-2 --key sampling.N --size 16x9 -o v --quiet
    expect 'any key may vary' "$status: $output $(cd v && echo planet-sampling*)" '0:  planet-sampling.N-1.jpg planet-sampling.N-2.jpg'
}

check_signals() {
    "${interruptible[@]}" "$strata" gallery --only ridges --size 1920x1080 -N 8 -o g >said &
    local pid=$!
    await_handler "$pid"
    until [[ -e g/wall.jpg ]] || ! kill -0 "$pid"; do sleep 0.05; done
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends with 130' "$?" 130
    expect_match 'what is finished is told' "$(<said)" '*stopped  with 1 of 2 pictures; the same command goes on*'
    expect 'and kept, with its time; the wall needs no large pictures' "$(cd g && echo *)" \
        'gallery.json ridges-small.jpg wall.jpg'
}

check_scales() {
    run gallery hills --scales 250,150,252,151 -N 1 --simd scalar -o s
    expect_match 'one place at three sizes' "$status: $output" '0: 2048 x 1152: RMSE * by sampling alone*16384 x 9216: RMSE *wrote *hills-scales.jpg*'
}

run_groups check_refusals check_gallery check_variants check_signals check_scales
