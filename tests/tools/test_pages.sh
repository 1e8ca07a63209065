#!/usr/bin/env bash
# What the README pages point to is there: files, headings and, between backquotes, paths of this tree.
set -u

root=$(readlink -f -- "${BASH_SOURCE[0]}")
root=${root%/tests/tools/*}
cd -- "$root" || exit 1
pages=(README.md src/README.md tools/README.md)
failed=0

fail() { # page what
    printf 'FAILED: %s: %s\n' "$1" "$2"
    failed=1
}

# The page without its blocks of commands.
text_of() { # page
    awk '/^```/ { code = !code; next } !code' "$1"
}

# Headings as links name them: small letters, words joined by -.
anchors_of() { # page
    text_of "$1" | sed -n 's/^##* //p' | tr '[:upper:]' '[:lower:]' | sed 's/[^a-z0-9 _-]//g; s/ /-/g'
}

check_links() { # page
    local link path target
    while IFS= read -r link; do
        path=${link%%#*}
        target=${1%README.md}$path
        [[ $path ]] || target=$1
        if [[ ! -e $target ]]; then
            fail "$1" "no file for the link $link"
        elif [[ $link == *'#'* ]] && ! anchors_of "$target" | grep -Fxq -- "${link#*#}"; then
            fail "$1" "no heading for the link $link"
        fi
    done < <(text_of "$1" | grep -oE '\]\([^)]+\)' | sed 's/^](//; s/)$//')
}

# Paths begin with a folder of this tree; capitals stand for names to choose.
check_paths() { # page
    local path
    # shellcheck disable=SC2016 # backquotes of the text
    while IFS= read -r path; do
        # A name without wildcards would match itself.
        [[ -e $path ]] || { [[ $path == *'*'* ]] && compgen -G "$path" >/dev/null; } || fail "$1" "no file $path"
    done < <(text_of "$1" | grep -oE '`(noise|shaders_cpu|src|tests|tools|\.ci)/[A-Za-z0-9_./*-]*`' | tr -d '`' |
        grep -vE 'NAME|FLOOR|UNIT|_K\.')
}

for page in "${pages[@]}"; do
    check_links "$page"
    check_paths "$page"
done
lines=$(wc -l <README.md)
((lines <= 120)) || fail README.md "$lines lines, allowed: 120; depth belongs to the other pages"
exit "$failed"
