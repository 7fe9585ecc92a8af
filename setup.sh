#!/bin/sh
# setup.sh LOG PACKAGE... - installs the Debian packages that dpkg does not know yet, named first;
# apt's words go to LOG. Asks neither apt nor the network when nothing is missing. Where there is
# no apt, LIBRARIES (names for pkg-config) must be there. What fails is told in one line.
set -u
log=$1
shift
fail() {
  echo "make setup: $*" >&2
  exit 1
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
  # shellcheck disable=SC2086
  pkg-config --exists $LIBRARIES 2>/dev/null ||
    fail 'no apt here: install C and C++ compilers, pkg-config, libtiff, OpenEXR 3.1 or newer, jansson, xxhash, CGAL, OpenImageIO, Embree 3, libpng, libepoxy, GLFW, POV-Ray 3.7 and oiiotool (make lamps: jq; tests: cmocka, GMP, bats, gnuplot, help2man, scdoc, tiffcp, groff, chromium, Xvfb, xdotool) by other means'
  exit 0
fi

# shellcheck disable=SC2016
have=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null | sed -n 's/^installed //p')
missing=
for package in "$@"; do
  printf '%s\n' "$have" | grep -qxF "$package" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "make setup: apt installs$missing"
root=
if [ "$(id -u)" != 0 ]; then
  root=sudo
  command -v sudo >/dev/null || fail "neither root nor sudo: as root, apt-get install$missing"
fi
mkdir -p "${log%/*}"
echo "make setup: this can take minutes; apt's words go to $log"
{
  $root env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  # shellcheck disable=SC2086
  $root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends $missing
} </dev/null >"$log" 2>&1 || {
  # Without network apt warns of that first, and then lacks the packages.
  reason=$(grep -m 1 'Failed to fetch' "$log" || grep -m 1 '^E: ' "$log" || tail -n 1 "$log")
  fail "apt could not install$missing: $(echo "$reason" | sed 's/^[EW]: //'); all of its words are in $log"
}
