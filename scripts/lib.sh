# Shared by the scripts beside it (POSIX shell, sourced after cd to the top of the repository).

BUILD_PACKAGES="cmake ninja-build g++ pkg-config libembree-dev libtbb-dev libhwy-dev libtinygltf-dev
libstb-dev libfast-float-dev libjsoncpp-dev libopenexr-dev libpng-dev
zlib1g-dev libopenvdb-dev libboost-iostreams-dev libcli11-dev libfmt-dev libgtest-dev
libgmock-dev libbenchmark-dev"
CHECK_PACKAGES="clang-format-16 clang-tidy-16"

say() { printf '%s\n' "$*"; }
die() { printf '%s: %s\n' "$0" "$*" >&2; exit 1; }

# missing_packages PACKAGE…: prints those that are not installed.
missing_packages() {
  for package in "$@"; do
    case "$(dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null)" in
      ?i*) ;;
      *) printf '%s ' "$package" ;;
    esac
  done
}

# as_root COMMAND…: runs it as root, or fails where that is not allowed.
as_root() {
  if [ "$(id -u)" = 0 ]; then
    "$@"
  elif command -v sudo >/dev/null 2>&1 && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
    sudo "$@"
  else
    return 1
  fi
}

# ensure_packages PACKAGE…: installs what is missing; PENUMBRA_NO_INSTALL=1 forbids that.
ensure_packages() {
  if ! command -v dpkg-query >/dev/null 2>&1 || ! command -v apt-get >/dev/null 2>&1; then
    say "This is no Debian system. What these Debian packages hold must be installed: $(echo "$@")"
    command -v cmake >/dev/null 2>&1 || die "cmake is missing"
    return 0
  fi
  missing=$(missing_packages "$@")
  [ -n "$missing" ] || return 0
  advice="missing packages: ${missing}- install them with: apt-get install ${missing% }"
  [ "${PENUMBRA_NO_INSTALL:-0}" = 0 ] || die "$advice"
  say "Installing $missing"
  as_root true || die "may not install (neither root nor sudo); $advice"
  as_root apt-get -qq update || say "apt-get update failed; trying with the lists that are here"
  # shellcheck disable=SC2086 # one word a package
  as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install \
    $missing >/dev/null || die "apt-get could not install; $advice"
}

# processors: how many jobs to run at once.
processors() { nproc 2>/dev/null || echo 2; }

# configure PRESET: quiet unless it fails.
configure() {
  launcher=
  ! command -v ccache >/dev/null 2>&1 || launcher=-DCMAKE_CXX_COMPILER_LAUNCHER=ccache
  mkdir -p build
  # shellcheck disable=SC2086 # empty when there is no ccache
  cmake --preset "$1" $launcher >"build/configure-$1.log" 2>&1 || {
    cat "build/configure-$1.log" >&2
    die "configuring the preset $1 failed"
  }
}

# build PRESET [TARGET…]
build() (
  preset=$1
  shift
  for target in "$@"; do set -- "$@" --target "$target"; shift; done
  cmake --build --preset "$preset" --parallel "$(processors)" "$@"
)

# seconds_since START: START from `date +%s.%N`.
seconds_since() { awk -v a="$1" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f s", b - a }'; }

# render SCENE PICTURE [options…]: unless the picture is newer than the program and all scenes.
render() (
  scene=$1
  picture=$2
  shift 2
  program=${PENUMBRA_PROGRAM:-build/release/bin/penumbra}
  if [ -e "$picture" ] && [ -z "$(find "$program" "$scene" scenes -newer "$picture" -type f)" ]; then
    say "$picture   (up to date)"
    return 0
  fi
  start=$(date +%s.%N)
  "$program" render "$scene" -o "$picture" --quiet "$@"
  say "$picture   $(seconds_since "$start")"
)
