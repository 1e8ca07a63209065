#!/usr/bin/env bash
# When the program asks the launcher's installer for gnuplot and ffmpeg: once it is certain that it needs them.
set -u

# shellcheck source=tests/tools/cli_checks.sh
. "${BASH_SOURCE[0]%/*}/cli_checks.sh"

# A machine without either program, and an installer that notes what it is asked for. STRATA_INSTALL=TEXT makes it
# "install" a program of that name that fails with code 7.
begin() {
    mkdir bin
    cat >installer <<'TEXT'
#!/bin/bash
echo "$*" >>asked
[[ ! ${STRATA_INSTALL-} ]] || { printf '#!/bin/sh\nexit 7\n' >"bin/$STRATA_INSTALL" && /bin/chmod +x "bin/$STRATA_INSTALL"; }
TEXT
    chmod +x installer
    export STRATA_INSTALLER=$PWD/installer
}

run() { # arguments...: sets output and status
    output=$(PATH=$PWD/bin "$strata" "$@" 2>&1 </dev/null)
    status=$?
}

asked() {
    local lines=''
    [[ ! -e asked ]] || lines=$(<asked)
    echo "$lines"
}

check_what_needs_none() {
    local command option
    begin
    for command in render scenes probe strip sweep animate figures converge stability explain bench; do
        for option in --help -h; do
            run "$command" "$option"
            expect "$command $option needs no package" "$status: $(asked)" '0: '
        done
    done
    for command in 'figures --only 1 --threads' 'figures --html --size' 'converge edge --N' 'converge nonsense --N' \
        'stability --seed' 'bench --repeat' 'animate planet --frames' 'animate wheel -o a.mp4 --threads'; do
        # shellcheck disable=SC2086 # words are meant
        run $command nonsense
        expect "'$command nonsense' is refused before any package" "$status: $(asked)" '2: '
        # shellcheck disable=SC2086
        run ${command% *} --nonsense
        expect "so is '${command% *} --nonsense'" "$status: $(asked)" '2: '
    done
    run animate wheel --size 8x8 -N 1 --frames 0 --quiet -o .mp4.png
    expect 'frames need no package, whatever their name' "$status: $(asked)" '0: '
    run stability --fast --only bspline --quiet
    expect 'nor does stability' "$status: $(asked)" '0: '
    run bench --quick --only subset --no-files --quiet
    expect 'nor does bench without files' "$status: $(asked)" '0: '
    run figures --only 6 --size small --html --no-films --quiet
    expect 'nor do figures without plots' "$status: $(asked)" '0: '
}

check_what_needs_some() {
    begin
    run animate wheel --size 8x8 -N 1 --frames 0 --quiet -o a.mp4
    expect_match 'a film asks for ffmpeg, and without it says where it is to be had' "$status: $output $(asked)" \
        '1: *ffmpeg is not installed*package ffmpeg video'
    export STRATA_INSTALL=gnuplot
    run figures --only 1 --size small --quiet
    expect_match 'what was installed is used' "$status: $output $(asked)" '1: *gnuplot: failed with code 7*video?plot'
}

run_groups check_what_needs_none check_what_needs_some
