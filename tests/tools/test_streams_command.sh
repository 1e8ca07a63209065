#!/usr/bin/env bash
# Pictures, reports and scenes through pipes and standard streams.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

tiny=(wheel --size 16x9 -N 1)

make_files() { "$strata" render "${tiny[@]}" -o a.exr -o a.png -o a.jpg -o a.tif --quiet; }

check_standard_output() {
    local format messages
    make_files
    for format in exr png jpg tif; do
        "$strata" render "${tiny[@]}" -o - --format "$format" --quiet | cat >by_option
        expect_same_file "-o - --format $format is the bytes of a file" by_option "a.$format"
        messages=$("$strata" render "${tiny[@]}" -o "$format:-" 2>&1 >by_name)
        expect_same_file "as is -o $format:-" by_name "a.$format"
        expect_match 'while messages are on standard error' "$messages" '*wrote *rays *memory *'
    done
    "$strata" render "${tiny[@]}" -o - >default 2>/dev/null
    expect_same_file 'without --format it is an EXR' default a.exr
    "$strata" render "${tiny[@]}" -o - --format float --quiet >piped.exr
    "$strata" render "${tiny[@]}" -o file.exr --format float --quiet
    expect_same_file 'and --format float says what its channels are' piped.exr file.exr
    { echo before && "$strata" render "${tiny[@]}" -o /dev/stdout --format png --quiet && echo behind; } >all
    expect_same_file 'what stands before and behind in a file stays' all <(echo before && cat a.png && echo behind)
    "$strata" render "${tiny[@]}" -o x.png --stats - 2>messages >s.json
    expect 'statistics are alone on standard output' "$(head -c 1 s.json)$(tail -n 1 s.json) $(grep -c wrote messages)" '{} 1'
    "$strata" explain "${tiny[@]}" --json - >plan.json 2>/dev/null
    expect 'as is a plan' "$(head -c 1 plan.json)$(tail -n 1 plan.json)" '{}'
    "$strata" strip a.png a.exr -o - >strip.png 2>/dev/null
    "$strata" strip a.png a.exr -o same.png --quiet
    expect_same_file 'a strip goes there as PNG' strip.png same.png
    "$strata" render "${tiny[@]}" -o - --aov steps --quiet >/dev/null
    expect 'pictures of costs get the name of the scene' "$(echo ./*.steps.png)" ./wheel.steps.png
}

check_pipes() {
    local reader
    make_files
    mkfifo pipe pipe.png
    cat pipe.png >read.png &
    reader=$!
    "$strata" render "${tiny[@]}" -o pipe.png -o also.png --quiet
    wait "$reader"
    expect_same_file 'a named pipe gets the picture of its extension' read.png a.png
    expect_same_file 'beside a file' also.png a.png
    expect 'and stays a pipe' "$(stat -c %F pipe.png)" fifo
    cat pipe >read.jpg &
    reader=$!
    "$strata" render "${tiny[@]}" -o pipe --format jpg --quiet
    wait "$reader"
    expect_same_file 'or of --format' read.jpg a.jpg
    # The reader of >() is not waited for.
    "$strata" render "${tiny[@]}" -o >(cat >part && mv part copy) --quiet
    until [[ -e copy ]]; do sleep 0.01; done
    expect_same_file 'so does >(a command)' copy a.exr
}

check_stream_refusals() {
    { sleep 0.2 && "$strata" render "${tiny[@]}" -o - --quiet 2>messages; echo "$?" >code; } | true
    expect_match 'a reader that goes early is told of' "$(<code): $(<messages)" '1: *cannot write "-": Broken pipe'
    output=$("$strata" render "${tiny[@]}" -o - 2>&1 >&-)
    expect_match 'a closed standard output is found out first' "$?: $output" '1: *"-": it is not open*'
    output=$("$strata" render "${tiny[@]}" -o - --quiet 2>&1 >/dev/full)
    expect_match 'a full one is told' "$?: $output" '1: *"-": No space left on device'
    refuses 'two pictures do not share standard output' 2 '*-o: two pictures for standard output*' render -o - -o png:-
    refuses 'nor do a picture and statistics' 2 '*--stats /dev/stdout: allowed: a file of its own*' render -o - --stats /dev/stdout
    refuses 'a format without a stream is refused' 2 '*--format png: allowed with -o - *' render -o a.exr --format png
    refuses 'an unknown format gets the known ones' 2 '*--format bmp: allowed: half, float; exr, png*' render -o - --format bmp
    refuses 'frames are no stream' 2 '*-o -: allowed: files*' animate wheel --frames 0 -o -
    mkfifo f.mp4
    refuses 'nor is a film' 2 '*-o f.mp4: allowed: files*' animate wheel --frames 0 -o f.mp4
    if command -v script >/dev/null; then
        output=$(script -qec "'$strata' render wheel --size 16x9 -o -" /dev/null </dev/null)
        expect_match 'a terminal is no place for a picture' "$output" '*a terminal does not show pictures*'
    fi
    "${interruptible[@]}" "$strata" render hyperterrain --size 320x180 -N 64 --quiet -o - >part &
    local pid=$!
    await_handler "$pid"
    sleep 0.5
    kill -TERM "$pid"
    wait "$pid"
    expect 'of an interrupted picture nothing goes into the stream' "$? $(stat -c %s part) $(echo .[!.]* *)" \
        '143 0 .[!.]* code f.mp4 messages part'
}

check_standard_input() {
    make_files
    "$strata" scenes wheel | "$strata" render - --size 16x9 -N 1 --quiet
    expect_same_file 'a scene comes from standard input' stdin.exr a.exr
    "$strata" render - --quiet -o again.png <a.exr
    expect_same_file 'as does a picture' again.png a.png
    "$strata" render <(cat a.png) --quiet -o again.exr
    expect_same_file 'and from <(a command)' again.exr a.exr
    # shellcheck disable=SC2094 # it writes other files
    output=$("$strata" strip a.exr - --parts -o strip.png --quiet 2>&1 <a.exr)
    expect_match 'a strip shows one from there' "$?: $output $(test -s strip-2.exr && echo there)" '0:  there'
    output=$("$strata" strip - - 2>&1 <a.exr)
    expect_match 'which is read once' "$?: $output" '2: *-: standard input is read already*'
    output=$("$strata" probe field - 2>&1 < <("$strata" scenes planet))
    expect_match 'points and a scene do not both come from there' "$?: $output" '2: *where the points are to come from*'
    output=$(printf '[camera]\nfov = 3\n' | "$strata" explain - 2>&1)
    expect_match 'a fault in it has its place' "$?: $output" '2: *standard input:2:1: camera.fov*'
    output=$("$strata" render - 2>&1 <&-)
    expect_match 'a closed one is told of' "$?: $output" '2: *-: cannot be read: Bad file*'
    output=$("$strata" render /dev/zero 2>&1)
    expect_match 'an endless device is read to the limit of scenes' "$?: $output" '2: */dev/zero:1:1: too large*'
}

run_groups check_standard_output check_pipes check_stream_refusals check_standard_input
