#!/usr/bin/env bash
# What is left when writing fails: every command of fault_cases.sh is run with its n-th call of a kind failing, for every
# n until it ends without that. PROGRAM PRELOAD [--every] [CASE...]; without --every some n, and the likelier errors.
set -u
shopt -s extglob globstar

here=${BASH_SOURCE[0]%/*}
# shellcheck source=tests/tools/cli_checks.sh
. "$here/../tools/cli_checks.sh"
# shellcheck source=tests/faults/fault_cases.sh
. "$here/fault_cases.sh"
preload=$(readlink -f -- "${2:?usage: ${0##*/} PROGRAM PRELOAD [--every] [CASE...]}")
shift 2
every=''
[[ ${1-} != --every ]] || { every=yes && shift; }
fake=$scratch/fake

declare -A reasons=([ENOSPC]='No space left on device' [EIO]='Input/output error' [EACCES]='Permission denied'
    [EBUSY]='Device or resource busy' [EMFILE]='Too many open files' [EAGAIN]='Resource temporarily unavailable')

# The errors of a kind that are tried: the first at many calls, the others at one.
errors_of() { # kind
    case $1 in
    open) echo ENOSPC ${every:+EMFILE EACCES} ;;
    write) echo ENOSPC SHORT ${every:+EIO EINTR} ;;
    read | close | fsync | truncate) echo EIO ${every:+ENOSPC} ;;
    rename | link | mkdir) echo EACCES ${every:+EBUSY} ;;
    spawn) echo EAGAIN ;;
    unlink) echo ${every:+EACCES} ;;
    thread) echo ${every:+EAGAIN} ;;
    esac
}

make_fake_programs() {
    mkdir "$fake"
    cat >"$fake/ffmpeg" <<'SHELL'
#!/bin/sh
for word; do case $word in */%d.png) frames=${word#file:} ;; esac; done
for ((i = 0; i < 2; ++i)); do cat "${frames%/*}/$i.png" || exit 3; done >"${word#file:}"
SHELL
    sed -i '1s/.*/#!\/bin\/bash/' "$fake/ffmpeg"
    chmod +x "$fake/ffmpeg"
}

# Runs a case's command in ./work; sets output and status. FAULT may be empty.
run_case() { # case fault
    local more=() command=()
    read -r -a command <<<"${words[$1]}"
    [[ ! ${with_fakes[$1]-} ]] || more+=("PATH=$fake:$PATH")
    mkdir -p tmp
    output=$(cd work && env "${more[@]}" TMPDIR="${PWD%/work}/tmp" LD_PRELOAD="$preload" STRATA_TEST_FAULT="$2" \
        STRATA_TEST_FAULT_LOG=../log timeout 120 "$strata" "${command[@]}" 2>&1 </dev/null)
    status=$?
}

files_in() { (cd "$1" && find . -type f -printf '%P\n' | sort); }

# ./before, ./after of a run without faults, ./log; the files have all to be there and to be readable.
prepare() { # case
    local file command
    mkdir -p before work
    if [[ ${earlier[$1]-} == *.* && ${earlier[$1]} != *' --'* ]]; then
        for file in ${earlier[$1]}; do
            [[ $file != */* ]] || mkdir -p "before/${file%/*}"
            echo earlier >"before/$file"
        done
    elif [[ ${earlier[$1]-} ]]; then
        read -r -a command <<<"${earlier[$1]}"
        (cd before && "$strata" "${command[@]}" 2>&1)
    fi
    cp -r before/. work
    run_case "$1" ''
    expect "$1 succeeds without faults" "$status: $output" "0: $([[ $1 == scenes || $1 == probe ]] && echo "$output")"
    mv work after
    expect "$1 leaves nothing hidden" "$(find after -name '.*' && ls -A tmp)" ''
    local pictures=()
    while IFS= read -r file; do
        [[ $file != *.@(exr|png|tif|jpg) ]] || pictures+=("$file")
        is_whole "after/$file" "after/$file" || expect "$1 writes a whole $file" broken whole
    done < <(files_in after)
    # Programs of others draw plots without a digest.
    for file in ${every:+"${pictures[@]}"}; do
        [[ $file != *error-*.png && $file != *figure-3.png && $file != *bench.png ]] || continue
        (cd after && "$strata" strip "$file" --quiet -o ../strip.png) || expect "$1 writes a readable $file" broken whole
    done
}

# By its format: what is written last is there.
is_whole() { # file, one that is whole
    case $1 in
    *.json) [[ $(head -c 1 "$1") == '{' && $(tail -c 2 "$1") == '}' ]] && ends_line "$1" ;;
    *.csv | *.md | *.txt) ends_line "$1" && (($(wc -l <"$1") == $(wc -l <"$2"))) ;;
    *.png) [[ $(tail -c 8 "$1" | od -An -c) == *'I   E   N   D'* ]] ;;
    *.svg | *.html) [[ $(tail -c 20 "$1") == *'</'@(svg|html)'>'* ]] ;;
    *) [[ -s $1 ]] ;;
    esac
}

ends_line() { [[ -s $1 && ! $(tail -c 1 "$1") ]]; }

# old, new, absent or broken.
state_of() { # case file
    local old=before/$2 new=after/$2 now=work/$2
    # shellcheck disable=SC2053 # patterns are meant
    if [[ ! -e $now ]]; then
        [[ -e $old && $2 != ${lost[$1]-} ]] && echo lost || echo absent
    elif [[ $2 == ${lost[$1]-} && $(<"$now") == '{}' ]]; then
        echo absent
    elif [[ -e $old ]] && cmp -s "$old" "$now"; then
        # What stays as it is, is no missing output.
        [[ -e $new ]] && cmp -s "$old" "$new" && echo new || echo old
    elif cmp -s "$new" "$now" || { [[ $2 == ${varying[$1]-} ]] && is_whole "$now" "$new"; }; then
        echo new
    elif [[ $2 == */figure-*.json && $(<"$now") == '{}' ]]; then
        echo absent # an emptied record says that its figure is still to be made
    else
        echo broken
    fi
}

# One run with a fault; says "fired" when it has come to it.
check_fault() { # case kind n error
    local name="$1 with $2:$3:$4" file state missing=() reason told='' failed
    cp -r ../before work
    ln -s ../before ../after .
    run_case "$1" "$2:$3:$4"
    failed=$(sed -n "s/^$2 [0-9]* failed //p" log)
    [[ $failed ]] || grep -q "^$2 [0-9]* failed" log || return
    echo >fired
    expect_match "$name ends by itself" "$status" '[01]'
    while IFS= read -r file; do
        state=$(state_of "$1" "$file")
        case $state in
        broken | lost) expect "$name: $file is as it was, or whole and new" "$state ($status: $output)" 'old or new' ;;
        new) ;;
        *) missing+=("$file") ;;
        esac
    done < <(cat <(files_in after) <(files_in before) | sort -u)
    while IFS= read -r file; do
        # shellcheck disable=SC2053 # patterns are meant
        [[ -e before/$file || -e after/$file || $file == ${extra[$1]-} || $output == *"${file##*/}"* || ${file##*/} == .* ]] ||
            expect "$name leaves no other file that is not said" "$file ($output)" ''
    done < <(files_in work)
    check_hidden "$name" "$2" "$failed"
    if ((${#missing[@]} > 0)); then
        expect "$name: ${missing[*]} not written, and the exit code tells" "$status: $output" "1: $output"
    fi
    ((status != 0)) || return
    [[ $4 != @(SHORT|EINTR) ]] || expect "$name is no error" "$status: $output" '0: '
    reason=${reasons[${4%%,*}]-}
    # Of two faults the graver one is told.
    [[ $4 != *,write:*:ENOSPC ]] || reason="@($reason|${reasons[ENOSPC]})"
    [[ $2 == thread ]] || expect_match "$name tells the reason" "$output" "*$reason*"
    # A table that is written again and again may be whole, and not the newest.
    for file in $(files_in after) "$PWD/tmp" "${failed##*/}"; do
        [[ $output != *"$file"* && $output != *"${file%.*}.partial.${file##*.}"* ]] || told=yes
    done
    # What made the folder names it, and not yet the files that were to be in it.
    [[ $2 != mkdir || $output != *"${failed%XXXXXX}"* ]] || told=yes
    [[ $2 == thread ]] || expect "$name names what was not written" "$told: $output" "yes: $output"
}

# What could not be removed is there, and what the message says; all else is not.
check_hidden() { # name kind failed
    local file hidden=''
    while IFS= read -r file; do
        [[ $output == *"$file"* || $2 == unlink && ($3 == *"$file" || $file == strata-*) ]] || hidden+=" $file"
    done < <(find work -name '.*' -printf '%f\n' && ls -A tmp)
    expect "$1 leaves nothing hidden" "$hidden" ''
}

# The same command once more, when nothing fails.
check_again() { # name case
    local file
    run_case "$2" ''
    expect "after $1 the same command succeeds" "$status: $output" "0: "
    while IFS= read -r file; do
        [[ $(state_of "$2" "$file") == new ]] || expect "after $1 the same command writes $file" "$(state_of "$2" "$file")" new
    done < <(files_in after)
}

attempt() { # case kind n error
    local folder=$2.$3.$4
    mkdir "$folder" && cd "$folder" || exit 1
    check_fault "$@"
    [[ ! $every || ! -e fired || $3 == *+ || $1 == @(scenes|probe) ]] || check_again "$1 with $2:$3:$4" "$1"
    [[ -e fired ]] && echo >"../fired.$folder"
    cd .. && rm -rf "$folder"
}

# A file that is read in many parts is like another.
most_of() { # kind count
    if [[ $1 == read && $2 -gt 30 ]]; then echo 30; else echo $(($2 + 1)); fi
}

# Of every call, of writes and opens also with all after it; or the first and the last.
numbers_of() { # kind, which of its errors, count
    if [[ $every && $2 == 0 ]]; then
        seq 1 "$(most_of "$1" "$3")"
        [[ $1 != @(open|write) ]] || seq -f '%g+' 1 $(($3 - 1))
    elif (($3 > 0)); then
        echo "$3"
        [[ $1 != @(write|mkdir) || $3 == 1 || $2 != 0 ]] || echo 1
    fi
}

check_case() { # case
    local kind n count which errors fired
    prepare "$1"
    for kind in open write read fsync rename link unlink truncate mkdir close spawn thread; do
        count=$(grep -c "^$kind " log)
        read -r -a errors <<<"$(errors_of "$kind")"
        for which in "${!errors[@]}"; do
            for n in $(numbers_of "$kind" "$which" "$count"); do attempt "$1" "$kind" "$n" "${errors[which]}"; done
        done
    done
    # A file that cannot be named may be copied, and then the disk is full.
    for n in $([[ ! $every ]] || seq 1 $(($(grep -c '^write ' log) * 2))); do
        attempt "$1" rename 1+ "EACCES,write:$n:ENOSPC"
    done
    fired=$(find . -name 'fired.*' | wc -l)
    echo "$1: $fired faults"
    # Otherwise the library does not see what the program calls.
    [[ $1 == @(scenes|probe) ]] || expect "faults come to $1" "$((fired >= 5))" 1
}

make_fake_programs
groups=()
for name in "${cases[@]}"; do
    [[ $# == 0 || " $* " == *" $name "* ]] || continue
    eval "check_$name() { check_case $name; }"
    groups+=("check_$name")
done
run_groups "${groups[@]}"
