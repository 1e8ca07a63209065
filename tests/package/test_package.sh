#!/usr/bin/env bash
# Strata as foreign projects get it: installed from a build folder into one of its own, found by CMake, linked, and held
# against the program.
set -u

build=$(readlink -f -- "${1:?usage: ${0##*/} BUILD_FOLDER PROGRAM COMPILER}")
strata=$(readlink -f -- "${2:?}")
export CXX=${3:?}
folder=$(readlink -f -- "${BASH_SOURCE[0]%/*}")
example=$(readlink -f -- "$folder/../../tools/example/example.cpp")
# shellcheck source=tests/package/checks.sh
. "$folder/checks.sh"
cd -- "$scratch" || exit 1

install_into() { # prefix component...
    local prefix=$1 component
    shift
    for component; do cmake --install "$build" --prefix "$prefix" --component "$component"; done >install.log 2>&1
    expect "cmake --install puts $* into place" "$?" 0
}

configure() { # name prefix option...: sets output
    local name=$1 prefix=$2
    shift 2
    output=$(cmake --fresh -G Ninja -S "$folder/$name" -B "$name" -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$prefix" "$@" 2>&1) &&
        output=configured
}

build_foreign() { # name prefix option...
    configure "$@"
    expect "a foreign project finds Strata: $1" "$output" configured
    output=$(cmake --build "$1" 2>&1) && output=built
    expect "a foreign project builds with Strata: $1" "$output" built
}

# Both say how they were made, so equal files mean equal pixels, settings and SIMD target.
check_picture() {
    build_foreign strata "$scratch/whole" -DEXAMPLE="$example"
    output=$(strata/example 2>progress.txt)
    expect_match 'the example renders, and its ray hits' "$output" '*rays in*hit at (*f there: *'
    expect_match 'the example tells its progress' "$(<progress.txt)" '* % of some *'
    "$strata" render terrain --size 160x90 -N 2 --set camera.fov_deg=40 --estimator stratified --format float --quiet \
        -o program.exr
    expect 'the library writes the very file that the program writes' "$(cmp example.exr program.exr 2>&1)" ''
    "$strata" render terrain --size 160x90 -N 2 --set camera.fov_deg=41 --estimator stratified --format float --quiet \
        -o other.exr
    expect_match 'another scene is another file' "$(cmp example.exr other.exr 2>&1)" '*differ*'
    output=$(strata/example missing.toml 2>&1)
    expect_match 'an error names its place' "$?: $output" '1: missing.toml: *'
}

check_probes() {
    local planet=(planet --set surface.spin_deg_per_s=90)
    {
        "$strata" probe ray "${planet[@]}" --pixel 640,360
        "$strata" probe ray "${planet[@]}" --pixel 0,0
        printf '0 0 100 0 0.01 -3\n0 0 100 0 0 1 0.5\n' | "$strata" probe ray "${planet[@]}"
        printf '1 2 3\n1 2 3 0.25\n' | "$strata" probe field "${planet[@]}"
    } >program.txt
    expect_match 'some of the rays hit' "$(<program.txt)" '*true*'
    expect 'rays and fields are those of the program to the last digit' "$(strata/probe_at 2>&1)" "$(<program.txt)"
}

# The program's numbers come from the reference path in double: f = y - F.
check_noise() {
    local points='0.3 0.2 0.1
-7.75 3.5 12.125
99 -99 0.001'
    build_foreign noise "$scratch/noise_alone"
    expect_match 'the noise links no part of the renderer' "$(ldd noise/fbm_at)" '*libhwy*'
    expect 'the noise needs Highway and the system' \
        "$(ldd noise/fbm_at | grep -vE 'linux-vdso|libhwy|libstdc|libm\.|libgcc|libc\.|ld-linux')" ''
    "$strata" probe field hyperterrain --set surface.octaves=8 --set surface.lacunarity=2 --set surface.gain=0.5 \
        --set surface.amplitude=0.6 --set surface.frequency=0.5 --set surface.seed=1 --set surface.scale=1 \
        --set surface.origin='[0,0,0]' --set surface.rotation_deg='[0,0,0]' <<<"$points" >field.txt
    # value, bound, slopes, bound, f, its gradient, octaves..., point
    output=$(noise/fbm_at <<<"$points" |
        paste -d ' ' - <(tr -d '{}[]"a-z:' <field.txt | tr , ' ') <(echo "$points") | awk '
        function off(a, b) { return a > b ? a - b : b - a }
        off($1, $(NF - 1) - $7) > $2 || off(-$3, $8) > $6 || off(1 - $4, $9) > $6 || off(-$5, $10) > $6 { wrong++ }
        END { print NR " points, " wrong + 0 " wrong" }')
    expect 'value and gradient are the program'"'"'s within their certificates' "$output" '3 points, 0 wrong'
}

check_refusals() {
    configure strata "$scratch/noise_alone" -DEXAMPLE="$example"
    expect_match 'the renderer is no target where the noise alone is installed' "$output" '*Strata::strata*not found*'
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(p NONE)\nfind_package(Strata %s)\n' \
        '0.1 REQUIRED COMPONENTS strata' >CMakeLists.txt
    output=$(cmake -S . -B refused -DCMAKE_PREFIX_PATH="$scratch/noise_alone" 2>&1)
    expect_match 'a missing component is named with its cure' "$output" "*component 'strata' is not installed*--component*"
    sed -i 's/0.1 REQUIRED.*/0.1 REQUIRED COMPONENTS nose)/' CMakeLists.txt
    output=$(cmake -S . -B refused -DCMAKE_PREFIX_PATH="$scratch/noise_alone" 2>&1)
    expect_match 'an unknown component gets the known ones' "$output" "*no component 'nose', allowed: noise, strata*"
    sed -i 's/0.1 REQUIRED.*/0.2 REQUIRED)/' CMakeLists.txt
    output=$(cmake -S . -B refused -DCMAKE_PREFIX_PATH="$scratch/noise_alone" 2>&1)
    expect_match 'a newer version is not found' "$output" '*requested version "0.2"*version: 0.1.0*'
}

# Symbols that another library could have as well; templates and inline functions of others are weak.
check_symbols() {
    local archive
    for archive in "$scratch"/whole/lib*/libstrata*.a "$scratch"/whole/lib*/*/libstrata*.a; do
        [[ -f $archive ]] || continue
        expect "every strong symbol is of the namespace strata: ${archive##*/}" \
            "$(nm -gC --defined-only "$archive" 2>/dev/null | sed -n 's/^[0-9a-f]* [TDBRG] //p' | grep -v 'strata::')" ''
    done
}

install_into "$scratch/whole" noise strata
install_into "$scratch/noise_alone" noise
expect 'every public header is installed' "$(ls whole/include/strata)" "$(cd "$folder/../../src" && ls -- *.h)"
expect 'the noise alone comes without the renderer' "$(find noise_alone -name '*strata.*' -o -name 'libstrata.a')" ''
check_picture
check_probes
check_noise
check_refusals
check_symbols
sum_up
