# shellcheck shell=bash disable=SC2034
# The Debian packages heml is built, run and tested with, how those that are missing get installed, and how heml is built.
# Sourced by app/start.sh and tests/run.sh.

build_packages=(
  cmake g++ ninja-build                              # tools
  libeigen3-dev libfmt-dev nlohmann-json3-dev zlib1g-dev  # engine
  libassimp-dev libtet1.5-dev                        # its helper for surfaces
  libcli11-dev libglfw3-dev libimgui-dev             # program
  libosmesa6-dev libpng-dev
  libspnav-dev                                       # and its SpaceMouse, which may be left out
  doctest-dev                                        # tests
)
run_packages=(
  libosmesa6                                         # drawing without a display
  libgl1 libgl1-mesa-dri                             # drawing in a window
  libxcursor1 libxi6 libxinerama1 libxrandr2         # what GLFW loads when it opens one
)
test_packages=(
  ccache                                             # what two presets share is compiled once
  clang libclang-rt-14-dev                           # sanitizers, fuzzing
  imagemagick python3 python3-dev python3-venv xauth xdotool xvfb             # a window with a mouse in it
  calculix-ccx python3-mpmath python3-numpy          # results to compare with
  dpkg-dev                                           # the Debian package
)

# say TEXT...: a line of ours, told apart from what the tools print.
say() { printf '\n== %s\n' "$*"; }

fail() {
  printf 'heml: %s\n' "$*" >&2
  exit 1
}

# install_missing PACKAGE...: quick and silent when all are there.
install_missing() {
  if ! command -v apt-get >/dev/null; then
    say "this is not Debian: taking for granted what these packages hold: $*"
    return
  fi
  local states package missing=() as_root=() attempt
  states=" $(dpkg-query --show --showformat '${Package}:${db:Status-Status} ' "$@" 2>/dev/null || true)"
  for package; do
    [[ $states == *" $package:installed "* ]] || missing+=("$package")
  done
  [[ ${#missing[@]} -eq 0 ]] && return
  if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null ||
      fail "packages are missing and there is no sudo; as root: apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "installing ${#missing[@]} Debian packages and what they need: ${missing[*]}"
  apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 "$@" </dev/null
  }
  for attempt in 1 2 3; do
    apt_get update && apt_get install --no-install-recommends "${missing[@]}" && return
    say "that failed (attempt $attempt of 3)"
    sleep $((attempt * 3))
  done
  fail "apt-get could not install ${missing[*]}"
}

# build PRESET [CMAKE BUILD OPTION...]: what changed, in the top folder. Configures every time: packages may have come.
build() {
  local preset=$1
  shift
  say "building $preset in build/$preset"
  cmake --preset "$preset" >/dev/null && cmake --build --preset "$preset" "$@"
}
