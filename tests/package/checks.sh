# shellcheck shell=bash
# How scripts of this folder say what they found; sourced by them.

scratch=$(mktemp -d) || exit 1
trap 'rm -rf -- "$scratch"' EXIT
passed=0 failed=0

expect() { # sentence actual expected
    if [[ $2 == "$3" ]]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'FAILED: %s\n  expected: %s\n  got:      %s\n' "$1" "$3" "${2:0:2000}"
    fi
}

expect_match() { # sentence actual pattern
    # shellcheck disable=SC2053 # a pattern is meant
    if [[ $2 == $3 ]]; then expect "$1" yes yes; else expect "$1" "$2" "$3"; fi
}

sum_up() {
    echo "$passed passed, $failed failed"
    ((failed == 0 && passed > 0))
}
