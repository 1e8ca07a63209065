#!/usr/bin/env bash
# Public headers, which are those right under src/: each compiles alone and without a warning, and includes nothing but
# the standard library and other public headers.
set -u

compiler=${1:?usage: ${0##*/} COMPILER}
folder=$(readlink -f -- "${BASH_SOURCE[0]%/*}")
headers=$(readlink -f -- "$folder/../../src")
# shellcheck source=tests/package/checks.sh
. "$folder/checks.sh"
cd -- "$scratch" || exit 1

# What the headers of C++20 include, but for <execution>, which brings TBB in. Those that this compiler lacks are left out.
list_standard_files() {
    local name
    for name in algorithm any array atomic barrier bit bitset cassert cctype cerrno cfenv cfloat charconv chrono cinttypes \
        climits clocale cmath codecvt compare complex concepts condition_variable coroutine csetjmp csignal cstdarg cstddef \
        cstdint cstdio cstdlib cstring ctime cuchar cwchar cwctype deque exception filesystem forward_list \
        fstream functional future initializer_list iomanip ios iosfwd iostream istream iterator latch limits list locale \
        map memory memory_resource mutex new numbers numeric optional ostream queue random ranges ratio regex \
        scoped_allocator semaphore set shared_mutex source_location span sstream stack stdexcept stop_token streambuf \
        string string_view syncstream system_error thread tuple type_traits typeindex typeinfo unordered_map \
        unordered_set utility valarray variant vector version; do
        printf '#if __has_include(<%s>)\n#include <%s>\n#endif\n' "$name" "$name"
    done >standard.cpp
    list_included standard.cpp | sort -u >standard.txt
}

# A line each; system headers too.
list_included() { # file
    "$compiler" -std=c++20 -M "$1" | sed 's/^[^:]*://' | tr -s '[:space:]\134' '\n' | sed '/^$/d' | while IFS= read -r file; do
        readlink -f -- "$file"
    done
}

# Files that a header includes and is not to.
list_foreign() { # header
    printf '#include "%s"\n' "$1" >one.cpp
    list_included one.cpp | grep -vxF -f standard.txt | grep -vE "^(${1%/*}/[a-z_]+\.h|$scratch/one\.cpp)\$"
}

list_standard_files
expect_match 'the standard headers are known' "$(grep -c . standard.txt)" '[1-9][0-9][0-9]*'
for header in "$headers"/*.h; do
    name=${header##*/}
    printf '#include "%s"\n#include "%s"\nint main() {}\n' "$header" "$header" >alone.cpp
    expect "$name compiles alone, twice and without a warning" \
        "$("$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror alone.cpp 2>&1)" ''
    expect "$name includes the standard library and public headers alone" "$(list_foreign "$header")" ''
done

# The check itself finds foreign headers.
mkdir spoilt
cp -- "$headers"/*.h spoilt/
for foreign in fmt/format.h glm/glm.hpp hwy/base.h oneapi/tbb/version.h toml++/toml.h OpenImageIO/oiioversion.h; do
    sed "s|#include \"error.h\"|&\n#include <$foreign>|" "$headers/strata.h" >spoilt/strata.h
    expect_match "$foreign in a public header is found" "$(list_foreign "$scratch/spoilt/strata.h")" "*/${foreign##*/}*"
done
sum_up
