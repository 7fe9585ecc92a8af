#!/bin/sh
# deb.sh ROOT VERSION SECONDS OUT.deb PACKAGE... - makes a Debian package of what `make install`
# put below ROOT (prefix /usr), which this script completes. It depends on PACKAGEs, and on the
# libraries that its programs load. The same files give the same bits: times are SECONDS (of Unix),
# and what tells of the machine that built them is taken off the programs.
set -eu
root=$1 version=$2 out=$4
export SOURCE_DATE_EPOCH="$3" LC_ALL=C
shift 4
needs=$(printf ', %s' "$@")
doc=$root/usr/share/doc/canned
whom='The Canned light sources maintainers <maintainers@canned.invalid>'

# Programs without what debuggers read.
root=$(realpath "$root")
programs() { find "$root/usr/bin" "$root/usr/lib" -type f ! -name '*.sh' ! -name 'canned-*' "$@"; }
programs -exec strip --strip-unneeded -R .comment -R .note.gnu.build-id {} +
libraries=$(
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
  mkdir "$scratch/debian"
  printf 'Source: canned\n\nPackage: canned\nArchitecture: any\n' >"$scratch/debian/control"
  cd "$scratch"
  programs -exec dpkg-shlibdeps -O {} + >found 2>log || { cat log >&2 && exit 1; }
  sed -n 's/^shlibs:Depends=//p' found
)

# What Debian asks of each package.
rm -f "$doc/LICENSE"
{
  printf 'Canned light sources. The code is GPL-3.0-or-later:\n/usr/share/common-licenses/GPL-3.\n\n'
  printf 'Lamps, what is in /usr/share/canned/include-pov, and all that the programs generate is CC0-1.0:\n'
  printf '/usr/share/common-licenses/CC0-1.0.\n\nCopyright (C) %s %s\n' "$(date -u +%Y -d "@$SOURCE_DATE_EPOCH")" "${whom% <*}"
} >"$doc/copyright"
printf 'canned (%s) unstable; urgency=medium\n\n  * This version.\n\n -- %s  %s\n' "$version" "$whom" \
  "$(date -u -R -d "@$SOURCE_DATE_EPOCH")" | gzip -9n >"$doc/changelog.gz"
find "$root/usr/share/man" -type f ! -name '*.gz' -exec gzip -9nf {} +

mkdir -p "$root/DEBIAN"
(cd "$root" && find usr -type f | sort | xargs -d '\n' md5sum) >"$root/DEBIAN/md5sums"
kilobytes=$(find "$root/usr" -type f -printf '%s\n' | awk '{ sum += int(($1 + 1023) / 1024) } END { print sum }')
cat >"$root/DEBIAN/control" <<END
Package: canned
Version: $version
Architecture: $(dpkg --print-architecture)
Maintainer: $whom
Installed-Size: $kilobytes
Depends: $libraries$needs
Recommends: bubblewrap, openssh-client, parallel, rsync
Suggests: gnuplot-nox, slurm-client
Section: graphics
Priority: optional
Description: near light of luminaires, simulated once and used anywhere
 Bakes a lamp that is written for POV-Ray into a light slab: the radiance
 through a rectangle, for every position and direction. Slabs light scenes of
 POV-Ray through include files, meshes by a renderer of their own, and go to
 other programs. With it come what bakes on a cluster need.
END
find "$root" -type d -exec chmod 755 {} +
find "$root" -type f -exec chmod u=rwX,go=rX {} +
dpkg-deb --root-owner-group --build "$root" "$out" >/dev/null
