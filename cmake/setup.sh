# Shared by ./run and ./test: installs what is missing (Debian packages), configures and builds. Sourced, not run.
# shellcheck shell=bash
# shellcheck source=cmake/machine.sh
. "${BASH_SOURCE[0]%/*}/machine.sh"
# shellcheck source=cmake/page.sh
. "${BASH_SOURCE[0]%/*}/page.sh"

say() { printf '%s\n' "motionrack: $*" >&2; }

# need_packages PACKAGE...: prints and installs the missing ones; fails with a message without root and sudo.
need_packages() {
    need_apt || return 1
    local missing=() package
    for package in "$@"; do
        dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    local sudo=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null 2>&1; then
            say "these Debian packages are missing: ${missing[*]}"
            say "run this script as root once, or install them with: apt-get install ${missing[*]}"
            return 1
        fi
        sudo=(sudo)
    fi
    say "installing Debian packages: ${missing[*]}"
    local log
    log=$(mktemp)
    if ! {
        # Repairs an interrupted installation first.
        "${sudo[@]}" dpkg --configure -a &&
            "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
                apt-get -o DPkg::Lock::Timeout=300 -y -q --fix-broken install &&
            "${sudo[@]}" apt-get -o DPkg::Lock::Timeout=300 -q update &&
            "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive \
                apt-get -o DPkg::Lock::Timeout=300 -y -q install --no-install-recommends "${missing[@]}"
    } >"$log" 2>&1; then
        tail -n 25 "$log" >&2
        why_apt_failed "$log"
        return 1
    fi
    rm -f "$log"
}

# without_ninja_idle FOLDER: passes the output of ninja on, after a message, once there is something to build.
without_ninja_idle() {
    local line said=""
    while IFS= read -r line; do
        case $line in
            "ninja: Entering directory"* | "ninja: no work to do"* | *"Re-checking globbed directories"*) continue ;;
        esac
        [ -n "$said" ] || say "building in $1 (the first time takes some minutes)"
        said=yes
        printf '%s\n' "$line"
    done
}

# build_in FOLDER TARGETS CMAKE-OPTIONS...: configures once, then builds what changed; prints nothing if there is
# nothing to do. A folder configured with tests also serves calls without them, so that ./run and ./test share one.
build_in() {
    local folder=$1 targets=$2
    shift 2
    if command -v ccache >/dev/null 2>&1; then
        set -- "$@" -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
    fi
    local stamp="$folder/.configured-with" want="$*" is
    is=$(cat "$stamp" 2>/dev/null) || is=""
    local wider=${want/MOTIONRACK_TESTS=OFF/MOTIONRACK_TESTS=ON}
    if [ ! -e "$folder/build.ninja" ] || { [ "$is" != "$want" ] && [ "$is" != "$wider" ]; }; then
        need_tools "$@" || return 1
        say "configuring in $folder"
        rm -f "$folder/CMakeCache.txt"
        cmake -S . -B "$folder" -G Ninja "$@" >"$folder.configure.log" 2>&1 || {
            cat "$folder.configure.log" >&2
            no_room "$folder" || say "cmake could not configure; see above"
            return 1
        }
        printf '%s' "$want" >"$stamp"
    fi
    # Leaves out the lines that ninja prints before it knows whether there is work.
    # shellcheck disable=SC2086  # the targets are words
    ninja -C "$folder" $targets 2>&1 | without_ninja_idle "$folder" >&2 || {
        no_room "$folder" || say "the build failed; see above"
        return 1
    }
}

# Options with which ./run and ./test configure build/release, besides MOTIONRACK_TESTS.
# shellcheck disable=SC2034  # both use it
release_options=(-DCMAKE_BUILD_TYPE=Release -DMOTIONRACK_WERROR=ON -DCMAKE_INSTALL_PREFIX=/usr)

run_packages=(g++ cmake ninja-build ccache
    libfmt-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libexpected-dev
    libfast-float-dev zlib1g-dev libpugixml-dev cyclonedds-dev cyclonedds-tools
    pkg-config librsvg2-dev fonts-dejavu-core libsqlite3-dev libhdf5-dev libboost1.81-dev libssl-dev libnats-dev)
python_packages=(pybind11-dev python3-dev python3-numpy python3-venv python3-pip)
release_packages=(dpkg-dev file)
# shellcheck disable=SC2034  # packaging/docs, packaging/release and ./test --all site have them installed
docs_packages=(mkdocs-material doxygen)
# shellcheck disable=SC2034  # packaging/windows has them installed
windows_packages=(cmake ninja-build ccache g++-mingw-w64-x86-64-posix g++-mingw-w64-i686-posix
    libfmt-dev libexpected-dev libfast-float-dev)
# shellcheck disable=SC2034  # tests/windows/run has them installed
wine_packages=(g++ wine wine64)
# shellcheck disable=SC2034  # bench/page has them installed
bench_packages=(python3 libbenchmark-dev verilator valgrind linuxcnc-uspace sigrok-cli)
# shellcheck disable=SC2034  # ./test has them installed
test_packages=("${run_packages[@]}" "${python_packages[@]}"
    black flake8 mypy shellcheck
    libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev clang libclang-rt-14-dev make
    python3-matplotlib python3-h5py iverilog verilator yosys fp-compiler fp-units-rtl octave sigrok-cli gtkwave
    linuxcnc-uspace bcnc xvfb xauth chromium nats-server libfuse3-dev fuse3 iproute2
    debootstrap "${release_packages[@]}" clang-format clang-tidy universal-ctags libz80ex-dev z80asm)
