# shellcheck shell=bash
# How a build folder is brought up to date; sourced by tools/strata, tools/test and tools/check, which set `root`.
#
# A build folder holds, beside CMake's and ninja's files:
#     built        fingerprint of the sources that the last complete build was made from
#     attempted    fingerprint of those that the last build, complete or not, started from
#     configured   what it was configured with
#     build.log    all that the last build printed
# Everything said here goes to standard error, and nothing reads standard input: both belong to the program.

# The caller's: folders under root that a build depends on, and options for CMake.
sources=()
options=()

builds=${STRATA_BUILD_DIR:-$root/.build}
[[ $builds == /* ]] || builds=$PWD/$builds

# What another folder or clone has compiled is not compiled again, where ccache is there and nothing else was chosen.
if [[ ! ${CMAKE_CXX_COMPILER_LAUNCHER+chosen} ]] && command -v ccache >/dev/null; then
    export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_BASEDIR=$root
fi

say() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }

die() {
    say "$@"
    exit 1
}

# One line (time of change, size, path) for each file that a build may depend on, so that an edited, a new, a deleted
# and a renamed file all show. All kinds of files count but texts, and pictures, which people render into any folder.
take_fingerprint() { # folder under root...
    fingerprint=$(find -L "$root/CMakeLists.txt" "${@/#/$root/}" -name '.?*' -prune -o -type f \
        ! -name '*~' ! -name '*.md' ! -name '*.exr' ! -name '*.png' ! -name '*.tif' ! -name '*.jpg' -printf '%T@ %s %p\n' 2>/dev/null)
}

# Whether FOLDER was built completely from what the fingerprint shows.
is_built() { # folder
    local built
    [[ -r $1/built ]] && IFS= read -r -d '' built <"$1/built" && [[ $built == "$fingerprint" ]]
}

# Ninja compares times alone, so it misses a file that was edited while it was being compiled, or replaced by one with
# an older time. Such files get the present time.
refresh_missed_edits() { # folder
    local line path missed=()
    local -A attempted=()
    [[ -f $1/attempted && -f $1/.ninja_log ]] || return 0
    while IFS= read -r line; do attempted[$line]=1; done <"$1/attempted"
    while IFS= read -r line; do
        path=${line#* * }
        [[ ${attempted[$line]-} || $path -nt $1/.ninja_log ]] || missed+=("$path")
    done <<<"$fingerprint"
    ((${#missed[@]})) || return 0
    touch -c -- "${missed[@]}" 2>/dev/null || ninja -C "$1" -t clean >/dev/null </dev/null
}

# Paths, options and the versions of the packages: with any of them changed, nothing in the folder can be trusted (a
# moved clone; headers of an upgraded package keep the times their packager gave them).
describe_configuration() { # folder option...
    printf '%s\n' "$root" "$@"
    # shellcheck disable=SC2016 # dpkg-query's variables, not the shell's
    grep -v -e '^#' -e '^\[' -e '^$' "$root/tools/setup/packages.txt" |
        xargs dpkg-query -W -f='${Package} ${Version} ${db:Status-Status}\n' 2>/dev/null
}

configure() { # folder what option...
    local folder=$1 what=$2 configuration
    shift 2
    configuration=$(describe_configuration "$folder" "$@")
    if [[ -f $folder/build.ninja && -f $folder/configured && $configuration == "$(<"$folder/configured")" ]]; then
        refresh_missed_edits "$folder"
        return
    fi
    show_step "configuring $what"
    rm -f "$folder/configured"
    [[ ! -f $folder/build.ninja ]] || ninja -C "$folder" -t clean >/dev/null 2>&1 </dev/null
    if ! cmake --fresh -G Ninja -S "$root" -B "$folder" "$@" >"$folder/build.log" 2>&1 </dev/null; then
        hide_step
        cat "$folder/build.log" >&2
        die "configuring $what failed: CMake's words are above; tools/README.md lists what is needed"
    fi
    printf '%s\n' "$configuration" >"$folder/configured"
}

# On a terminal that can erase a line: what goes on, in one line that is written over, cut to the terminal's width.
can_erase() { [[ -t 2 && ${TERM:-dumb} != dumb ]]; }
show_step() {
    local width
    can_erase || return 0
    width=$(stty size <&2 2>/dev/null) && width=${width#* }
    ((${width:-0} > 0)) || width=80
    printf '\r\033[K%.*s' $((width - 1)) "$1" >&2
}
hide_step() { ! can_erase || printf '\r\033[K' >&2; }

# Copies what ninja says and shows how far it is, once a second even where one source takes longer.
follow_ninja() { # what
    local text='' part steps='' start=$SECONDS status=0
    while ((status == 0 || status > 128)); do # above 128: the second is over, and `part` may be half a line
        IFS= read -r -t 1 part
        status=$?
        text+=$part
        if ((status <= 128)) && [[ $text || $status == 0 ]]; then
            printf '%s\n' "$text"
            [[ ! $text =~ ^\[([0-9]+/[0-9]+)\] ]] || steps=${BASH_REMATCH[1]}
            text=''
        fi
        [[ ! $steps ]] || show_progress "$1" "$steps" $((SECONDS - start))
    done
}

show_progress() { # what done/all seconds
    local share=$((100 * ${2%/*} / ${2#*/}))
    show_step "building $1: $share %, ${2%/*} of ${2#*/} steps, $(($3 / 60)):$(printf %02d $(($3 % 60)))"
}

compile() { # folder what target...
    local folder=$1 what=$2 status
    shift 2
    show_step "building $what"
    NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" 2>&1 </dev/null | follow_ninja "$what" >"$folder/build.log"
    status=${PIPESTATUS[0]}
    hide_step
    ((status == 0)) && return
    # Files of ninja's own that it cannot read have to be made anew.
    ! grep -q -E '^ninja: error: .*\.ninja' "$folder/build.log" || rm -f "$folder/configured"
    grep -v -E '^(\[[0-9]+/[0-9]+\]|ninja: Entering|-- )' "$folder/build.log" >&2
    die "building $what failed; the errors are above, all output is in $folder/build.log"
}

# Brings TARGET in FOLDER up to date with the sources, or ends the script with a message. Several may call this
# at once: one builds, the others wait. A killed build's compilers hold the lock until they have ended.
update_build() { # folder what target
    mkdir -p "$1" 2>/dev/null
    [[ -d $1 && -w $1 ]] || die "cannot write to $1: set STRATA_BUILD_DIR to a folder of your own to build in"
    trap 'hide_step; exit 130' INT
    exec 9>"$1/lock"
    flock -n 9 || { say "waiting for another build in $1" && flock 9; } || die "cannot lock $1/lock"
    take_fingerprint "${sources[@]}"
    if ! is_built "$1"; then
        rm -f "$1/built"
        configure "$1" "$2" "${options[@]}"
        take_fingerprint "${sources[@]}" # refreshed files have new times
        printf '%s\n' "$fingerprint" >"$1/attempted"
        compile "$1" "$2" "$3"
        printf '%s\0' "$fingerprint" >"$1/built"
    fi
    exec 9>&-
    trap - INT
}
