#!/usr/bin/env bash
# What tools/strata promises whatever program it starts, shown with a tiny one in a scratch clone. Needs no network and
# installs nothing. The clone's path has spaces in it.
set -u

sources=$(readlink -f -- "${BASH_SOURCE[0]}")
sources=${sources%/tests/tools/*}
scratch=$(mktemp -d) || exit 1
trap 'rm -rf -- "$scratch"' EXIT
unset STRATA_BUILD_DIR
export STRATA_SETUP=skip
clone="$scratch/a clone"
strata=$clone/tools/strata
passed=0 failed=0

expect() { # sentence actual expected
    if [[ $2 == "$3" ]]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s\n  expected: %q\n  got:      %q\n' "$1" "$3" "$2"
    fi
}

expect_match() { # sentence actual pattern
    # shellcheck disable=SC2053 # a pattern is meant
    if [[ $2 == $3 ]]; then expect "$1" yes yes; else expect "$1" "$2" "$3"; fi
}

write_program() { # version
    cat >"$clone/tools/strata.cpp" <<TEXT
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <unistd.h>
#include "../src/number.h"
int main(int count, char** arguments) {
    char folder[4096];
    if (count > 2 && !std::strcmp(arguments[1], "exit")) return std::atoi(arguments[2]);
    if (count > 1 && !std::strcmp(arguments[1], "copy")) {
        for (int c; (c = std::getchar()) != EOF;) std::putchar(c);
        return 0;
    }
    std::printf("$1.%d %s", kNumber, getcwd(folder, sizeof folder));
    for (int i = 1; i < count; ++i) std::printf(" <%s>", arguments[i]);
    std::printf("\\n");
}
TEXT
}

make_clone() {
    mkdir -p "$clone/src" "$clone/shaders_cpu" "$clone/noise" "$clone/tools/setup"
    cp "$sources/tools/strata" "$clone/tools/"
    cp "$sources"/tools/setup/* "$clone/tools/setup/"
    cat >"$clone/CMakeLists.txt" <<'TEXT'
cmake_minimum_required(VERSION 3.25)
project(strata LANGUAGES CXX)
add_subdirectory(tools)
TEXT
    echo 'add_executable(strata strata.cpp)' >"$clone/tools/CMakeLists.txt"
    echo 'constexpr int kNumber = 1;' >"$clone/src/number.h"
    write_program one
}

# Puts CONTENT in FILE with a time before the last build, as restoring an old copy does.
replace_with_older() { # file content
    printf '%s\n' "$2" >"$1"
    touch -d '2001-02-03' "$1"
}

check_first_start() {
    local i answers
    for i in 1 2 3 4; do "$strata" "$i" >"$scratch/out$i" 2>"$scratch/err$i" & done
    wait
    answers=$(cat "$scratch"/out?)
    expect 'four starts at once on a fresh clone all run the program' "$answers" \
        "$(for i in 1 2 3 4; do echo "one.1 $PWD <$i>"; done)"
    expect 'only one of them builds' "$(grep -c 'Linking' "$clone/.build/release/build.log")" 1
    expect 'a build that succeeds says nothing in a pipe, but that others wait' \
        "$(cat "$scratch"/err? | grep -v 'waiting for another build')" ''
}

check_pass_through() {
    # shellcheck disable=SC2016 # nothing is to expand
    expect 'arguments arrive as they were given' "$("$strata" 'a b' '' '*' '$HOME' -- "'\"" 2>&1)" \
        "one.1 $PWD <a b> <> <*> <\$HOME> <--> <'\">"
    "$strata" exit 37
    expect "the program's exit code is the launcher's" $? 37
    expect 'standard input reaches the program' "$(printf 'x\ny' | "$strata" copy)" $'x\ny'
}

check_folders() {
    mkdir -p "$scratch/else where" "$scratch/bin"
    expect 'the program runs in the folder of the caller' "$(cd "$scratch/else where" && "$strata")" \
        "one.1 $scratch/else where"
    expect 'it starts from its own folder' "$(cd "$clone/tools" && CDPATH=.. bash strata)" "one.1 $clone/tools"
    ln -s "../a clone/tools/strata" "$scratch/bin/once"
    ln -s once "$scratch/bin/twice"
    expect 'it starts through a link to a link' "$(cd / && "$scratch/bin/twice" z)" 'one.1 / <z>'
    expect 'it starts by its name on the PATH' "$(cd / && PATH="$scratch/bin:$PATH" once)" 'one.1 /'
}

check_rebuilds() {
    local before after
    before=$(stat -c %Y.%i "$clone/.build/release/build.log")
    touch "$clone/terrain.exr" "$clone/tools/terrain.png" "$clone/README.md" "$clone/tools/README.md"
    "$strata" >/dev/null
    after=$(stat -c %Y.%i "$clone/.build/release/build.log")
    expect 'pictures and texts do not cause a build' "$after" "$before"
    write_program two
    expect 'an edited source is built' "$("$strata" 2>&1)" "two.1 $PWD"
    replace_with_older "$clone/src/number.h" 'constexpr int kNumber = 2;'
    expect 'a header replaced by one with an older time is built' "$("$strata" 2>&1)" "two.2 $PWD"
    mv "$clone/src/number.h" "$scratch/"
    expect_match 'a deleted header is noticed' "$("$strata" 2>&1)" '*number.h*building strata failed*'
    mv "$scratch/number.h" "$clone/src/"
    expect 'and put back, it is built' "$("$strata" 2>&1)" "two.2 $PWD"
    rm "$clone/.build/release/tools/strata"
    expect 'a deleted program is built' "$("$strata" 2>&1)" "two.2 $PWD"
    # A compiler so slow that somebody edits a header between its being read and the object's being written.
    cat >"$clone/slow" <<'TEXT'
"$@" || exit
echo 'constexpr int kNumber = 3;' >"${0%/*}/src/number.h"
sleep 0.05
for argument; do case $argument in *.o) touch "$argument" ;; esac; done
TEXT
    # shellcheck disable=SC2016 # CMake's variable
    echo 'set_property(TARGET strata PROPERTY CXX_COMPILER_LAUNCHER sh "${CMAKE_SOURCE_DIR}/slow")' \
        >>"$clone/tools/CMakeLists.txt"
    expect 'a header is edited while it is being compiled' "$("$strata" 2>&1)" "two.2 $PWD"
    # shellcheck disable=SC2016 # the inner shell's arguments
    echo '"$@"' >"$clone/slow"
    expect 'and the edit is built at the next start' "$("$strata" 2>&1)" "two.3 $PWD"
    echo 'add_executable(strata strata.cpp)' >"$clone/tools/CMakeLists.txt"
}

check_progress() {
    write_program two
    expect_match 'on a terminal a build tells how far it is, and clears the line' \
        "$(TERM=xterm script -qec "'$strata'" /dev/null </dev/null)" \
        $'*building strata: 50 %, 1 of 2 steps, 0:0*\r\e[Ktwo.3*'
}

check_failures() {
    local said status
    echo 'int main() { return nonsense; }' >"$clone/tools/strata.cpp"
    said=$("$strata" 2>&1)
    status=$?
    expect 'a build that fails ends with 1' "$status" 1
    expect_match "with the compiler's message, then what failed" "$said" \
        "*strata.cpp:1:*nonsense*strata: building strata failed*"
    expect 'nothing of it on standard output, where the old program does not run either' "$("$strata" 2>/dev/null)" ''
    write_program three
    echo 'no_such_command()' >>"$clone/CMakeLists.txt"
    expect_match 'a CMakeLists.txt that fails is shown' "$("$strata" 2>&1)" '*no_such_command*failed*'
    sed -i '$d' "$clone/CMakeLists.txt"
    expect 'after both are put right it runs' "$("$strata" 2>&1)" "three.3 $PWD"
}

check_moves() {
    mv "$clone" "$scratch/moved"
    clone=$scratch/moved
    strata=$clone/tools/strata
    expect 'a moved clone is configured anew' "$("$strata" 2>&1)" "three.3 $PWD"
    write_program four
    expect 'and follows its sources at the new place' "$("$strata" 2>&1)" "four.3 $PWD"
    expect 'STRATA_BUILD_DIR says where to build' \
        "$(cd "$scratch" && STRATA_BUILD_DIR='el se' "$strata" 2>&1 && ls 'el se')" "four.3 $scratch"$'\n'release
    expect_match 'a folder that cannot be made is refused with what to do' \
        "$(STRATA_BUILD_DIR=/proc/none "$strata" 2>&1)" '*cannot write*STRATA_BUILD_DIR*'
}

# An installer that notes what it is asked for. What commands need they ask for themselves.
check_packages() {
    local command answer
    mv "$clone/tools/setup/install" "$scratch/install"
    # shellcheck disable=SC2016 # the script's own
    printf '#!/bin/sh\necho "$*" >>"%s"\n' "$scratch/asked" >"$clone/tools/setup/install"
    chmod +x "$clone/tools/setup/install"
    "$strata" >/dev/null 2>&1 # it is a source, and the program built anew
    rm -f "$scratch/asked"
    for command in figures converge stability bench 'bench --peers' animate 'animate -o a.mp4'; do
        for answer in '--help' '-h' '--version' '--wrong' 'x'; do
            # shellcheck disable=SC2086 # words are meant
            "$strata" $command $answer >/dev/null 2>&1
        done
    done
    expect 'the launcher installs nothing for a command of a program that is built' "$(cat "$scratch/asked" 2>/dev/null)" ''
    rm "$clone/.build/release/tools/strata"
    "$strata" figures --help >/dev/null 2>&1
    expect 'and for one that is not, what building needs' "$(cat "$scratch/asked")" build
    cat >"$clone/tools/strata.cpp" <<'TEXT'
#include <cstdio>
#include <cstdlib>
int main() { std::printf("%s %s\n", std::getenv("STRATA_INSTALLER"), std::getenv("STRATA_LAUNCHER")); }
TEXT
    expect 'the program knows by whom to install' "$("$strata" 2>/dev/null)" "$clone/tools/setup/install $clone/tools/strata"
    mv "$scratch/install" "$clone/tools/setup/install"
    write_program four
    "$strata" >/dev/null 2>&1
}

check_interruption() {
    local builder
    write_program five
    setsid "$strata" >/dev/null 2>&1 &
    builder=$!
    sleep 0.2
    kill -9 -- "-$builder" 2>/dev/null
    wait "$builder" 2>/dev/null
    expect 'after a build was killed the next start completes it' "$("$strata" 2>/dev/null)" "five.3 $PWD"
}

# A dpkg-query that knows of no package, and an identity without rights where there is one to give up.
check_missing_packages() {
    local said as=()
    mkdir -p "$scratch/fake"
    printf '#!/bin/sh\nexit 1\n' >"$scratch/fake/dpkg-query"
    chmod 755 "$scratch" "$scratch/fake" "$scratch/fake/dpkg-query"
    ((EUID)) || as=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    said=$(cd / && unset STRATA_SETUP && PATH="$scratch/fake:$PATH" "${as[@]}" "$clone/tools/setup/install" build 2>&1)
    expect 'without packages and rights set-up fails' $? 1
    expect_match 'and says what to type' "$said" '*sudo apt-get install --no-install-recommends *g++ cmake *'
}

make_clone
check_first_start
check_pass_through
check_folders
check_rebuilds
check_progress
check_failures
check_moves
check_packages
check_interruption
if grep -qs 'VERSION_ID="12"' /etc/os-release && command -v dpkg-query >/dev/null; then check_missing_packages; fi
printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
