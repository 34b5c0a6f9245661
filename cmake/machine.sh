# Used by cmake/setup.sh: checks of the machine, each with a message that has the remedy. Sourced, not run.
# shellcheck shell=bash

# shellcheck disable=SC2016  # the reader's shell expands it
instead='Use Debian 12, or a container of it: podman run -it -v "$PWD:/motionrack" -w /motionrack debian:12 ./run'

# os_field NAME: prints a field of /etc/os-release, such as VERSION_ID; nothing if it does not exist.
os_field() { sed -n "s/^$1=\"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p" /etc/os-release 2>/dev/null || true; }

system_name() {
    local name
    name=$(os_field PRETTY_NAME)
    printf '%s' "${name:-a system without a name in /etc/os-release}"
}

is_debian_12() { [ "$(os_field ID) $(os_field VERSION_ID)" = "debian 12" ]; }

# need_apt: fails with a message on a system without apt-get or dpkg-query.
need_apt() {
    if command -v apt-get >/dev/null 2>&1 && command -v dpkg-query >/dev/null 2>&1; then return 0; fi
    say "this machine is $(system_name), without apt-get: motionrack is built with packages of Debian 12." \
        "Nothing was installed or built. $instead"
    return 1
}

# why_apt_failed LOG: prints the reasons for the failure of apt-get, with their remedies.
why_apt_failed() {
    local log=$1 unknown unreached
    if grep -qE 'No space left on device|enough free space' "$log"; then
        say "only $(free_mb /var/cache/apt/archives) MB are free in /var/cache/apt/archives, too little for packages;" \
            "they were not installed. Make room (apt-get clean), then run $0 again."
        return 0
    fi
    unknown=$(sed -nE -e "s/^E: Unable to locate package //p" \
        -e "s/^E: Package '(.*)' has no installation candidate/\1/p" "$log")
    unknown=${unknown//$'\n'/ }
    unreached=$(grep -oE "(Temporary failure|Could not) resolv(e|ing) '?[^ ']+" "$log" ||
        grep -oE 'Could not connect to [^ ]+|Network is unreachable' "$log" ||
        grep -oE 'Failed to fetch [^ ]+' "$log" || true)
    unreached=${unreached%%$'\n'*}
    if [ -n "$unreached" ]; then
        say "packages could not be fetched from the network (${unreached/\'/}); they were not installed." \
            "Bring the network up (behind a proxy: set http_proxy, which sudo has to keep), then run $0 again."
    fi
    if [ -n "$unknown" ] && ! is_debian_12; then
        say "this machine is $(system_name), whose packages lack $unknown; motionrack needs those of Debian 12." \
            "Nothing was installed or built. $instead"
    elif [ -n "$unknown" ] && [ -z "$unreached" ]; then
        say "apt-get does not know $unknown, which Debian 12 has; nothing was installed or built. Put this line into" \
            "/etc/apt/sources.list, then run $0 again: deb http://deb.debian.org/debian bookworm main"
    elif [ -z "$unreached" ]; then
        say "apt-get failed; the whole log is $log. Do what it says, then run $0 again."
    fi
}

# ---- programs ----

# older VERSION LEAST: succeeds if VERSION is older, as 3.18.4 is older than 3.25.
older() { [ "$1" != "$2" ] && [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]; }

# need_program NAME PACKAGE: fails with a message without the program: an installed package may have lost its files.
need_program() {
    command -v "$1" >/dev/null 2>&1 && return 0
    say "there is no program $1 in PATH, although the Debian package $2 is installed. Nothing was configured." \
        "Put it back with: apt-get install --reinstall $2"
    return 1
}

# need_compiler WORDS...: fails with a message unless the C++ compiler (options as in CXX) works and is not too old.
need_compiler() {
    local said version least=12 scratch
    if ! command -v "$1" >/dev/null 2>&1; then
        say "the compiler $1, which CXX or -DCMAKE_CXX_COMPILER names, is not there. Nothing was configured." \
            "Unset CXX for g++, or name one that is there: g++ 12 or newer, or clang++ 14 or newer."
        return 1
    fi
    said=$("$@" --version 2>&1) || said=
    version=$("$@" -dumpfullversion -dumpversion 2>/dev/null) || version=
    case $said in *clang*) least=14 ;; esac
    if [ -n "$version" ] && older "$version" "$least"; then
        say "the compiler $1 is version $version; motionrack needs g++ 12 or newer, or clang++ 14 or newer." \
            "Nothing was configured. Name a newer one with CXX=..., or use Debian 12, which has both."
        return 1
    fi
    scratch=$(mktemp -d)
    printf '#include <compare>\nint main() {}\n' >"$scratch/a.cpp"
    if "$@" -std=c++20 "$scratch/a.cpp" -o "$scratch/a" >"$scratch/log" 2>&1; then
        rm -rf "$scratch"
        return 0
    fi
    no_room "$scratch" || say "the compiler $1 cannot make an empty program ($(tail -n 1 "$scratch/log"))." \
        "Nothing was configured. Mend it (apt-get install --reinstall g++ g++-12 libstdc++-12-dev)," \
        "or name another with CXX=..."
    rm -rf "$scratch"
    return 1
}

# need_tools CMAKE-OPTIONS...: fails with a message unless cmake, ninja and the compiler are there and new enough.
need_tools() {
    local word compiler=() version
    need_program cmake cmake || return 1
    need_program ninja ninja-build || return 1
    version=$(cmake --version | sed -n 's/^cmake version \([0-9.]*\).*/\1/p')
    if older "$version" 3.25; then
        say "cmake is version $version; motionrack needs 3.25 or newer. Nothing was configured." \
            "Put a newer one first in PATH, or use Debian 12, which has it."
        return 1
    fi
    read -ra compiler <<<"${CXX:-}"
    for word in "$@"; do
        case $word in -DCMAKE_CXX_COMPILER=*) compiler=("${word#*=}") ;; esac
    done
    # Without a named compiler, CMake takes the first of these that exists.
    for word in c++ g++ clang++; do
        if [ ${#compiler[@]} -eq 0 ] && command -v "$word" >/dev/null 2>&1; then compiler=("$word"); fi
    done
    [ ${#compiler[@]} -gt 0 ] || need_program g++ g++ || return 1
    need_compiler "${compiler[@]}"
}

# ---- disk space ----

# free_mb FOLDER: prints the free space, MB, of the disk of a folder, which may not exist yet.
free_mb() {
    local folder=$1
    while [ ! -d "$folder" ]; do folder=$(dirname "$folder"); done
    df -Pk "$folder" | awk 'NR == 2 {print int($4 / 1024)}'
}

# no_room FOLDER: after a failure, succeeds with a message if less than 200 MB are free in FOLDER or where the compiler
# writes. No file of a build is larger than that, and a file that did not fit is removed again.
no_room() {
    local folder
    for folder in "$(realpath -m "$1")" "${TMPDIR:-/tmp}"; do
        [ "$(free_mb "$folder")" -lt 200 ] || continue
        say "only $(free_mb "$folder") MB are free in $folder; the build is not finished." \
            "One for ./run takes up to 300 MB, one for ./test up to 4 GB. Make room, then run $0 again: it goes on" \
            "where it was."
        return 0
    done
    return 1
}
