#!/usr/bin/env bash
# What the strata program promises on its command line, shown with tiny pictures.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(--size 16x9 -N 2 --quiet)
number='-?[0-9]+(\.[0-9]+)?(e[+-][0-9]+)?'
vector="\[$number,$number,$number\]"

# Lines of $1 that are not wholly $2.
strays() { grep -Evxc -- "$2" <<<"$1"; }

check_unknown_words() {
    refuses 'a misspelt command gets the nearest name' 2 "*rendr*did you mean 'render'*" rendr
    refuses 'a misspelt command of probe gets the nearest name' 2 "*feild*did you mean 'field'*" probe feild
    refuses 'a misspelt option gets the nearest name' 2 "*--estimatr*did you mean '--estimator'*" render --estimatr sobol
    refuses 'a misspelt option with a value attached gets the nearest name' 2 "*did you mean '--size'*" render --siz=2x2
    refuses 'an unknown letter gets the allowed options' 2 '*-Q: unknown option*--quiet*' render -Q
    refuses 'no command names the commands' 2 '*render, merge, farm, scenes, probe*'
    refuses 'a second scene is one argument too many' 2 '*planet: one argument too many*' render terrain planet
    refuses 'a misspelt scene gets the nearest name' 2 "*did you mean 'hyperterrain'*" render hyperterain
    refuses 'a misspelt scene to print gets the nearest name' 2 "*did you mean 'hills'*" scenes hils
    refuses 'an option without its value says so' 2 '*--order*M missing*' render -m
}

check_wrong_values() {
    refuses 'an N out of range tells the range' 2 '*-N 65: sampling.N: out of range*1 to 64*' render -N 65
    refuses 'an N without a meaning is refused' 2 '*-N 010: sampling.N: not a value*' render -N 010
    refuses 'an m out of range tells the range' 2 '*1 to 100*' render -m 0
    refuses 'an unknown estimator gets the nearest name' 2 "*did you mean 'stratified'*" render --estimator stratifed
    refuses 'a size needs two numbers' 2 '*WIDTHxHEIGHT*' render --size 16
    refuses 'a size too large for memory is refused with the way out' 2 '*GB of memory*--crop*' render --size 65536x65536 \
        --passes 2
    refuses 'an inverted crop is refused' 2 '*--crop 5,5,2,2:*x0 < x1 <= 16*' render --size 16x9 --crop 5,5,2,2
    refuses 'a crop beyond the frame is refused' 2 '*--crop 0,0,17,9:*' render --size 16x9 --crop 0,0,17,9
    refuses 'a crop with a negative corner is refused' 2 '*--crop -1,0,4,4:*' render --crop -1,0,4,4
    refuses 'a crop of junk is refused' 2 '*--crop 1,2,3,x:*' render --crop 1,2,3,x
    refuses 'negative threads are refused' 2 '*--threads -1: allowed*' render --threads -1
    refuses 'a tile of 0 is refused' 2 '*--tile 0: allowed*' render --tile 0
    refuses 'an unknown SIMD target gets those that are here' 2 '*--simd mmx: allowed*scalar*' render --simd mmx
    refuses 'an unknown tracer gets the known ones' 2 '*fast, reference*' render --tracer exact
    refuses 'an unknown EXR format gets the known ones' 2 '*half, float*' render --format double
    refuses '--set names the nearest key' 2 "*did you mean 'camera.fov_deg'*" render --set camera.fov=3
    refuses '--set without = says what is allowed' 2 "*no '='*" render --set camera
    refuses '--set refuses NaN' 2 '*camera.fov_deg: not a finite number (nan)*' render --set camera.fov_deg=nan
    refuses 'octaves beyond double precision are refused' 2 '*octave*2^50*' render hills --set surface.octaves=32 \
        --set surface.lacunarity=10
}

check_scene_files() {
    : >empty.toml
    head -c 300 "$strata" >junk.toml
    printf '[camera]\nfov_deg = nan\n' >nan.toml
    printf '[camera]\n\nfov_dg = 30\n' >unknown.toml
    printf 'P6 1 1 255\n' >foreign.ppm
    mkdir folder.toml planet
    refuses 'a missing scene file is named' 2 '*missing.toml: no such file*' render missing.toml
    refuses 'an empty scene file is refused with a way out' 2 '*empty.toml:1:1: empty*' render empty.toml
    refuses 'binary junk is refused' 2 '*junk.toml:1:*not text*' render junk.toml
    refuses 'NaN in a scene file is refused with its place' 2 '*nan.toml:2:*camera.fov_deg*nan*0.01 to 179*' render nan.toml
    refuses 'an unknown key is refused with its place and the nearest' 2 \
        "*unknown.toml:3:1: camera.fov_dg*did you mean 'camera.fov_deg'*" render unknown.toml
    refuses 'a folder is no scene' 2 '*folder.toml: a folder*' render folder.toml
    run render planet "${tiny[@]}"
    expect 'a folder does not hide a built-in scene of its name' "$status: $output" '0: '
    printf '\x89PNG\r\n\x1a\nnonsense' >damaged.png
    refuses 'a damaged picture is refused as a scene' 2 '*damaged.png*' render damaged.png
    # One black pixel, as another program writes it.
    printf '%b' '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\001\0\0\0\001\010\002\0\0\0\x90wS\xde\0\0\0\014IDAT\x08\xd7c```\0\0' \
        '\0\004\0\001\x27\x34\x27\x0a\0\0\0\0IEND\xaeB`\x82' >foreign.png
    refuses 'a picture of another program is refused as a scene' 2 '*foreign.png*strata did not write it*' render foreign.png
}

check_outputs() {
    refuses 'an unknown extension is refused with the known ones' 2 '*.bmp*.exr, .png*' render -o a.bmp
    refuses 'a missing folder is named' 1 '*"nowhere" does not exist*' render -o nowhere/a.exr
    mkdir folder.exr
    refuses 'a folder is no output' 1 '*folder.exr*folder*' render -o folder.exr
    refuses 'a statistics file that cannot be written is found out first' 1 '*nowhere*' render --stats nowhere/s.json
    refuses 'statistics do not replace a picture' 2 '*--stats a.png: allowed: a file of its own*' render -o a.png --stats a.png
    expect 'nothing is written when something is refused' "$(echo *)" folder.exr

    run scenes --relief
    expect_match 'every kind of relief term is listed with its keys and bounds' "$status: $output" \
        '0: *gullies: *of 1 to 2 other terms*slope*bend*lacunarity*curve: *from*numbers -1e+06 to 1e+06*craters: *worn*'
    "$strata" scenes terrain >'my scene v1.2.toml'
    run render 'my scene v1.2.toml' --size 16x9 -N 2
    expect 'names with dots and blanks make output names' "$(ls -- my*)" \
        'my scene v1.2.exr'$'\n''my scene v1.2.png'$'\n''my scene v1.2.toml'
    expect_match 'the summary tells what was written, time, rays and memory' "$status: $output" \
        '0: *wrote *.exr*wrote *.png*time *rays *memory *'
    run render hills "${tiny[@]}" --estimator stratified --crop 3,2,9,7 -o twice.png -o ./twice.png -o t.tif -o t.jpg -o t.exr --stats s.json
    expect '--quiet prints nothing' "$status: $output" '0: '
    expect 'each output is there' "$(echo t*)" 't.exr t.jpg t.tif twice.png'
    local missing='' key
    for key in rays shadow_rays hits unresolved_rays noise_evaluations executed_lanes steps seconds cpu_seconds threads phases \
        simd_target peak_memory_bytes scene version; do
        grep -q "^  \"$key\": ..*" s.json || missing+=" $key"
    done
    expect 'the statistics hold every key' "$missing" ''
    expect 'the statistics count the rays of the crop' "$(grep '^  "rays"' s.json)" '  "rays": 120,'
}

check_rendering_again() {
    "$strata" scenes hyperterrain >hyperterrain.toml
    "$strata" render hyperterrain "${tiny[@]}" -o a.exr -o a.png
    "$strata" render hyperterrain.toml "${tiny[@]}" --threads 1 --tile 5 -o b.exr -o b.png
    expect_same_file 'a printed scene gives the same EXR, whatever threads and tiles' a.exr b.exr
    expect_same_file 'a printed scene gives the same PNG, whatever threads and tiles' a.png b.png
    "$strata" render hyperterrain --quiet --size 24x13 --crop 3,2,20,11 --format float --simd scalar --tracer reference \
        -N 3 -m 3 --estimator shared --seed 7 --time-order 2 --frame 3 --exposure 1.5 --set camera.fov_deg=35 \
        -o c.exr -o c.png -o c.tif
    "$strata" render c.exr --quiet -o d.exr -o d.png -o d.tif
    expect_same_file 'an EXR rendered again from its metadata is the same EXR' c.exr d.exr
    expect_same_file 'an EXR rendered again from its metadata is the same PNG' c.png d.png
    expect_same_file 'an EXR rendered again from its metadata is the same TIFF' c.tif d.tif
    "$strata" render c.png --quiet -o e.exr
    expect_same_file 'a PNG rendered again from its metadata is the same EXR' c.exr e.exr
    "$strata" render d.tif --quiet -o f.png
    expect_same_file 'a TIFF rendered again from its metadata is the same PNG' c.png f.png
    "$strata" render a.exr --quiet --crop 0,0,16,9 -o g.exr
    expect_same_file 'a crop that is the whole frame is no crop' a.exr g.exr
    "$strata" render hyperterrain "${tiny[@]}" --tiled -o tiled.exr -o tiled.png
    "$strata" render tiled.exr --quiet -o tiled_again.exr
    expect_same_file 'a tiled EXR rendered again is the same tiled EXR' tiled.exr tiled_again.exr
    expect 'the tiled bit is set where it was asked for' "$(head -c 6 a.exr | tail -c 1 | od -An -tu1 | tr -d ' ') \
$(head -c 6 tiled.exr | tail -c 1 | od -An -tu1 | tr -d ' ')" '0 2'
    "$strata" render c.exr --quiet --size 48x26 -o larger.exr
    "$strata" render hyperterrain --quiet --size 48x26 --crop 6,4,40,22 --format float --simd scalar --tracer reference \
        -N 3 -m 3 --estimator shared --seed 7 --time-order 2 --frame 3 --exposure 1.5 --set camera.fov_deg=35 \
        -o same.exr
    expect_same_file 'a crop rendered again at another size shows the same part of the frame' larger.exr same.exr
    run render c.exr --quiet --set film.width=2 --set film.height=1 -o smallest.exr
    expect 'and keeps a pixel of the smallest frame' "$status: $output" '0: '
    run explain c.exr --size 48x26 --no-pilot --json plan.json --quiet
    expect 'explain tells of the same crop' "$(tr -d ' \n' <plan.json | grep -o '"crop":[^]]*]')" '"crop":[6,4,40,22]'
}

check_aovs() {
    refuses 'an unknown AOV gets the known ones' 2 '*--aov step: allowed: all, or some of *steps,evals*' render --aov step
    refuses 'AOVs of several passes are refused' 2 '*--aov: allowed with one pass*' render --aov steps --passes 2
    refuses 'a picture does not take the place of an AOV' 2 '*-o a.steps.png: allowed: another name*' \
        render --aov steps -o a.exr -o a.steps.png
    "$strata" render terrain "${tiny[@]}" -o plain.exr -o plain.png
    "$strata" render terrain "${tiny[@]}" --aov evals,steps -o a.exr -o a.png
    expect 'each AOV is a picture beside the first output' "$(echo a.*)" 'a.evals.png a.exr a.png a.steps.png'
    expect 'channels are named in the EXR' "$(grep -aoc 'evals.Y' a.exr) $(grep -aoc 'steps.Y' plain.exr)" '1 0'
    "$strata" render a.exr --quiet -o b.exr
    expect_same_file 'an EXR with AOVs rendered again has them again' a.exr b.exr
    expect_same_file 'as have the pictures to look at' a.steps.png b.steps.png
}

check_probes() {
    local lines positions
    lines=$(printf '0\n1\n0.1\n1e-300\n\n0.5' | "$strata" probe bspline -m 20)
    local form="\{\"y\":$number,\"x\":$number,\"cdf\":$number,\"pdf\":$number,\"iterations\":[0-9]+,\"bulk_x\":$number,"
    form+="\"paper_x\":($number|null),\"paper_iterations\":([0-9]+|null)\}"
    expect 'probe bspline answers each line in its form' "$(wc -l <<<"$lines") $(strays "$lines" "$form")" '5 0'
    expect_match 'numbers have 17 digits' "$lines" '*"y":0.10000000000000001,*'
    lines=$(printf '0\n1\n1e-300\n' | "$strata" probe bspline -m 100)
    expect 'the paper method ends at m = 20' "$(grep -c '"paper_x":null,"paper_iterations":null' <<<"$lines")" 3
    expect 'probe bspline has no NaN at the ends' "$(strays "$lines" "$form")" 0
    lines=$(echo 1e-60 | "$strata" probe bspline -m 32 |
        sed 's/.*"x":\([^,]*\),.*"bulk_x":\([^,]*\),.*/\1 \2/' | awk '{ print ($1 > 0.1 && $1 - $2 < 1e-6 && $2 - $1 < 1e-6) }')
    expect 'bulk_x keeps its accuracy below the range of float' "$lines" 1
    lines=$(printf '0.5\n1.5\n' | "$strata" probe bspline 2>&1)
    expect_match 'a y outside [0,1] is named with its line' "$lines" "*stdin:2: '1.5', allowed: one y in \[0,1\]"

    coproc "$strata" probe bspline
    local answer='' input=${COPROC[1]}
    echo 0.5 >&"$input"
    read -r -t 20 answer <&"${COPROC[0]}"
    exec {input}>&-
    wait "$COPROC_PID"
    expect_match 'a probe answers each line before the next is asked' "$answer" '*"y":0.5,"x":2,*'

    positions=$'0 0 0\n1.5 -2 1e3\n-7 0.25 3 0.5'
    lines=$("$strata" probe field planet <<<"$positions")
    form="\{\"f\":$number,\"gradient\":$vector,\"octaves\":\[$number(,$number)*\]\}"
    expect 'probe field answers each line in its form' "$(wc -l <<<"$lines") $(strays "$lines" "$form")" '3 0'
    lines=$("$strata" probe field hills <<<$'1 2 3\n1 2' 2>&1 >/dev/null)
    expect_match 'a line with too few numbers is named' "$lines" "*stdin:2: '1 2', allowed: x y z*"
    lines=$("$strata" probe field hills <<<'1 nan 3' 2>&1)
    expect_match 'NaN on stdin is refused' "$lines" "*stdin:1: '1 nan 3'*"
    lines=$("$strata" probe field hills <<<'1e300 0 0' 2>&1)
    expect_match 'a position beyond double precision is refused' "$lines" '*stdin:1:*surface.origin*'

    lines=$("$strata" probe ray hills <<<$'0 5 0 0 -1 0\n0 5 0 0 1 0\n0 5 0 1e-320 -3e200 0')
    form="\{\"origin\":$vector,\"direction\":$vector,\"hit\":(true,\"t\":$number,\"position\":$vector,\"normal\":$vector"
    form+="|false,\"t\":null,\"position\":null,\"normal\":null),\"steps\":[0-9]+,\"noise_evaluations\":[0-9]+\}"
    expect 'probe ray answers each line in its form' "$(wc -l <<<"$lines") $(strays "$lines" "$form")" '3 0'
    expect 'a hit, a miss, a hit by a direction of any length' \
        "$(grep -o '"hit":[a-z]*' <<<"$lines" | tr '\n' ' ')" '"hit":true "hit":false "hit":true '
    lines=$("$strata" probe ray hills <<<'0 0 0 0 0 0' 2>&1)
    expect_match 'a ray without a direction is refused' "$lines" "*stdin:1: '0 0 0 0 0 0'*direction*"
    refuses 'a sample beyond the last is refused' 2 '*--sample 16: allowed*0 to 15*' probe ray hills --estimator stratified --pixel 0,0 --sample 16
    refuses 'a pixel outside the frame is refused' 2 '*--pixel 16,0: allowed*x < 16*' probe ray --size 16x9 --pixel 16,0
}

check_samples() {
    local estimator lines form="\{\"u\":$number,\"v\":$number,\"time\":$number,\"weight\":$number\}"
    for estimator in none super uniform jittered stratified random sobol shared shared-sobol; do
        lines=$("$strata" probe samples wheel --size 16x9 --pixel 15,0 -N 3 -m 3 --estimator "$estimator")
        expect "samples of $estimator are in their form, their weights sum to 1" \
            "$(strays "$lines" "$form") $(awk -F '[:}]' '{ sum += $5 } END { print (sum - 1 < 1e-12 && 1 - sum < 1e-12) }' \
                <<<"$lines")" '0 1'
    done
    # A pixel on the horizon.
    local i hits=0 rendered
    for i in 0 1 2 3; do
        "$strata" probe ray hyperterrain --size 16x9 -N 2 --pixel 5,2 --sample "$i" | grep -q '"hit":true' && hits=$((hits + 1))
    done
    "$strata" render hyperterrain --size 16x9 -N 2 --crop 5,2,6,3 --quiet -o pixel.png --stats s.json
    rendered=$(sed -n 's/ *"hits": \([0-9]*\),/\1/p' s.json)
    expect 'probe ray traces the samples that render uses' "$hits" "$rendered"
}

start_render() { # output arguments...: sets pid once the program listens to signals
    local name=$1
    shift
    "${interruptible[@]}" "$strata" render hyperterrain --size 320x180 -N 64 --quiet --no-journal -o "$name" "$@" &
    pid=$!
    await_handler "$pid"
}

check_signals() {
    echo earlier >a.exr
    start_render a.exr
    sleep 1
    kill -INT "$pid"
    wait "$pid"
    expect 'SIGINT ends a render with 130' "$?" 130
    expect 'an earlier picture stays' "$(cat a.exr)" earlier
    run render a.partial.exr --quiet --size 16x9 -N 1 -o again.exr
    expect 'the interrupted picture can be read' "$status: $output" '0: '

    start_render b.png --threads 1 --tile 1024
    kill -TERM "$pid"
    wait "$pid"
    expect 'SIGTERM before the first tile ends a render with 143' "$?" 143
    run render b.partial.png --quiet --size 16x9 -N 1
    expect 'the picture interrupted before its first tile can be read; whole again, it loses the .partial' \
        "$status: $output $(echo b*)" '0:  b.exr b.partial.png b.png'
}

check_failing_writes() {
    echo earlier >a.exr
    output=$(ulimit -f 20 && "$strata" render hills --size 64x36 -N 1 --format float --quiet -o a.exr -o a.png 2>&1)
    expect_match 'a full disk is told' "$?: $output" '1: strata: cannot write "a.exr": File too large'
    output=$(ulimit -f 2 && "$strata" render hyperterrain --size 320x360 -N 8 --estimator shared --quiet -o full.exr --stats s.json 2>&1)
    expect_match 'a render none of whose files can be written fails' "$?: $output" '1: *full.exr*'
    expect 'a render none of whose files can be written stops early' \
        "$(sed -n 's/ *"rays": \([0-9]*\),/\1/p' s.json | awk '{ print ($1 > 0 && $1 < 320 * 360 * 64 / 2) }')" 1
    rm s.json
    expect 'a full disk leaves the earlier file, and no other' "$(cat a.exr) $(ls -A)" 'earlier a.exr'$'\n''a.png'
    run render a.png --quiet --size 16x9 -o b.png
    expect 'the other output is written nevertheless' "$status: $output" '0: '
    if [[ $EUID -ne 0 ]]; then
        chmod a-w a.png
        refuses 'a read-only file is refused' 1 '*a.png*Permission denied*' render -o a.png
    fi
    output=$("$strata" scenes 2>&1 >/dev/full)
    expect_match 'output on a full disk is an error' "$?: $output" '1: *standard output: No space left*'
    "$strata" scenes >&- 2>/dev/null
    expect 'closed output is an error' "$?" 1
    output=$(set -o pipefail; { "$strata" scenes terrain; "$strata" scenes terrain; } 2>&1 | head -1)
    expect_match 'a reader that goes early is no error' "$?: $output" '0: *'
    "$strata" render hills --size 16x9 -N 1 -o closed.png >&- 2>/dev/null
    "$strata" render hills --size 16x9 -N 1 -o open.png --quiet
    expect_same_file 'pictures do not depend on standard output' closed.png open.png
    run --version
    expect_match 'there is a version' "$status: $output" '0: strata [0-9]*.[0-9]*'
    run probe ray --help
    expect_match 'there is help for each command' "$status: $output" '0: *--sample*'
}

run_groups check_unknown_words check_wrong_values check_scene_files check_outputs check_rendering_again \
    check_aovs check_probes check_samples check_signals check_failing_writes
