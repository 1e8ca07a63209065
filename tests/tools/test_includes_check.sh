#!/usr/bin/env bash
# What `tools/check includes` promises, shown on a scratch tree of three floors.
set -u

sources=$(readlink -f -- "${BASH_SOURCE[0]}")
sources=${sources%/tests/tools/*}
scratch=$(mktemp -d) || exit 1
trap 'rm -rf -- "$scratch"' EXIT
export STRATA_SETUP=skip
tree="$scratch/a tree"
passed=0 failed=0

expect() { # sentence actual expected
    if [[ $2 == "$3" ]]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s\n  expected: %q\n  got:      %q\n' "$1" "$3" "$2"
    fi
}

# Prints what the check says, and its exit code on a line of its own.
check() {
    (cd "$tree" && tools/check includes 2>&1)
    printf '%d\n' "$?"
}

write() { # path line...
    mkdir -p "$tree/${1%/*}" && printf '%s\n' "${@:2}" >"$tree/$1"
}

mkdir -p "$tree/tools" && cp -R "$sources/tools/setup" "$tree/tools/" && cp "$sources/tools/check" "$tree/tools/"
git -C "$tree" init --quiet
write tools/setup/floors.txt '# lowest first' 'low' 'middle middle/part  # one floor' 'top top/...'
write low/a.h '#pragma once'
write middle/b.h '#include <vector>' '#include "low/a.h"' '#include "middle/part/c.h"'
write middle/part/c.h '// #include "top/d.h"' '#include "middle/b.h"'
write top/far/below/d.h '#include "middle/b.h"' '#include "e.h"'
write top/far/below/e.h '#include "low/a.h"'
expect 'includes downward, within a floor and beside the file pass' "$(check)" 0

write low/a.h '#pragma once' '' '  #  include "middle/b.h"'
expect 'a header of ours that includes upward is named with its line and both floors' "$(check)" \
    'low/a.h:3: includes "middle/b.h": upward, from floor low to floor middle'$'\n1'
write low/a.h '#pragma once'

write middle/part/c.cpp '#include "middle/part/c.h"' '#include "top/far/below/d.h"'
expect 'so is a source, from and to folders within floors' "$(check)" \
    'middle/part/c.cpp:2: includes "top/far/below/d.h": upward, from floor middle/part to floor top/...'$'\n1'
write middle/part/c.cpp ''

write middle/part/c.cpp '#include "../../top/far/below/d.h"'
expect 'a path with dots goes round no floor' "$(check)" \
    'middle/part/c.cpp:1: includes "../../top/far/below/d.h", which is neither at the root of the sources nor beside this file'$'\n1'
write middle/part/c.cpp ''

write low/cellar/f.h '#pragma once'
expect 'a folder that the table leaves out is named' "$(check)" \
    'low/cellar/f.h:1: folder low/cellar is no floor of tools/setup/floors.txt'$'\n1'
rm -r "$tree/low/cellar"
expect 'and all is well again without it' "$(check)" 0

printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
