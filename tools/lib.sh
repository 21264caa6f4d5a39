# Shared by the programs in tools/: packages, configuring, building. Sourced, not run.
# shellcheck shell=bash disable=SC2034

# The top folder of the source tree.
sb_root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)

# Packages for building, testing and running; then those that only plots and films need.
sb_packages=(build-essential cmake ninja-build pkg-config git libosmesa6-dev liblcm-dev liblcm-bin
             libglib2.0-dev libassimp-dev libmeshoptimizer-dev libgeotiff-dev libnetcdf-dev libproj-dev libcglm-dev
             libpng-dev libdeflate-dev libyaml-dev libjansson-dev libmicrohttpd-dev
             libjs-dygraphs libncurses-dev libcmocka-dev tmux)
sb_picture_packages=(gnuplot-nox ffmpeg)
# Packages for runs over several processes or machines.
sb_cluster_packages=(libopenmpi-dev openmpi-bin)

sb_say() { printf '== %s\n' "$*"; }

sb_die() {
    printf '%s: %s\n' "$(basename -- "$0")" "$*" >&2
    exit 1
}

# Prints those of the named packages that are not installed, one per line.
sb_missing() {
    local package state
    for package; do
        state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
        [[ $state == installed ]] || printf '%s\n' "$package"
    done
}

# Installs the named packages that are missing; prints nothing if none is missing.
sb_need() {
    local missing=() as_root=() log
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        printf '%s: no Debian package tools here; assuming that these are installed: %s\n' \
            "$(basename -- "$0")" "$*" >&2
        return 0
    fi
    mapfile -t missing < <(sb_missing "$@")
    ((${#missing[@]})) || return 0
    sb_say "installing ${missing[*]}"
    if ((EUID != 0)); then
        command -v sudo >/dev/null ||
            sb_die "not root and no sudo; as root run: apt-get install ${missing[*]}"
        as_root=(sudo)
    fi
    log=$(mktemp)
    if ! { "${as_root[@]}" apt-get update &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
            apt-get install --yes --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
        tail -n 20 "$log" >&2
        rm -f "$log"
        sb_die "apt-get could not install: ${missing[*]}"
    fi
    rm -f "$log"
}

# Runs a command; shows its output only if it fails.
sb_quietly() {
    local log status=0
    log=$(mktemp)
    "$@" >"$log" 2>&1 || status=$?
    ((status == 0)) || tail -n 60 "$log" >&2
    rm -f "$log"
    return "$status"
}

# Configures a preset (with further cmake arguments) and builds the targets in SB_TARGETS, or all.
sb_build() {
    local preset=$1
    shift
    (
        cd -- "$sb_root" || exit
        sb_quietly cmake --preset "$preset" "$@" || sb_die "cannot configure the preset $preset"
        # shellcheck disable=SC2086 # a list of targets
        sb_quietly cmake --build --preset "$preset" ${SB_TARGETS:+--target $SB_TARGETS} ||
            sb_die "the preset $preset does not build"
    )
}

# sb_exec NAME [PACKAGE...] -- ARGUMENTS...: builds shorebreak-NAME and the shorebreak that it runs, installs the packages,
# and replaces the script by the program. For --help, --list and --version an existing program is not built again.
sb_exec() {
    local name=$1 packages=() argument quick=0
    shift
    while [[ $1 != -- ]]; do
        packages+=("$1")
        shift
    done
    shift
    for argument; do
        case $argument in
        --help | --list | --version) quick=1 ;;
        esac
    done
    if ((!quick)) || [[ ! -x $sb_root/build/release/shorebreak-$name ]]; then
        sb_need "${sb_packages[@]}" "${packages[@]}" >&2
        SB_TARGETS="shorebreak shorebreak-$name" sb_build release >&2
    fi
    exec "$sb_root/build/release/shorebreak-$name" "$@"
}

# Sets sb_launch to the words that start a program on so many ranks of this machine, with further words for mpirun.
sb_mpirun() {
    local ranks=$1
    shift
    sb_launch=(mpirun --bind-to none --oversubscribe -n "$ranks" "$@")
    ((EUID != 0)) || sb_launch+=(--allow-run-as-root)
}

# Prints the value of a key of a run's summary.
sb_value() { sed -n "s/^ *\"$2\": \"\\{0,1\\}\\([^\",]*\\)\"\\{0,1\\},\\{0,1\\}\$/\\1/p" "$1/summary.json" | head -n 1; }

# Whether two runs have ended in the same state with the same tables and maps; prints each difference.
sb_same_run() {
    local same=0 file name
    if [[ $(sb_value "$1" state_hash) != "$(sb_value "$2" state_hash)" ]]; then
        printf '%s and %s: the states differ\n' "$1" "$2"
        same=1
    fi
    for file in "$1"/*.csv "$1"/maps/*.asc; do
        [[ -e $file ]] || continue
        name=${file#"$1"/}
        cmp -s -- "$file" "$2/$name" && continue
        printf '%s and %s: %s differs\n' "$1" "$2" "$name"
        same=1
    done
    return "$same"
}
