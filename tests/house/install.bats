#!/usr/bin/env bats
# make install, and what is installed: the programs, their data, their man pages.
load house

setup_file() {
  load house
  # The program finds its data from where it lies: DESTDIR will do for running it.
  export DEST=$BATS_FILE_TMPDIR/dest PREFIX=$BATS_FILE_TMPDIR/dest/usr
  house_make B="$BATS_FILE_TMPDIR/build" config=debug prefix=/usr DESTDIR="$DEST" install
}

@test "the programs, include files, man pages and documents are installed" {
  cmp "$ROOT/include-pov/canned.inc" "$PREFIX/share/canned/include-pov/canned.inc"
  cmp "$ROOT/include-pov/LICENSE" "$PREFIX/share/canned/include-pov/LICENSE"
  cmp "$ROOT/README.md" "$PREFIX/share/doc/canned/README.md"
  cmp "$ROOT/lamps/parabolic.pov" "$PREFIX/share/doc/canned/lamps/parabolic.pov"
  [ -s "$PREFIX/lib/canned/reads.so" ]
  [ -s "$PREFIX/share/man/man5/light-slab.5" ]
  for program in bakeslab renderslab; do
    [ -x "$PREFIX/bin/$program" ]
    [ -s "$PREFIX/share/man/man1/$program.1" ]
    for command in $(commands "$PREFIX/bin/$program"); do
      [ -s "$PREFIX/share/man/man1/$program-$command.1" ]
    done
  done
}

@test "uninstall leaves nothing" {
  cp -a "$DEST" "$BATS_TEST_TMPDIR/dest"
  house_make B="$BATS_FILE_TMPDIR/build" config=debug prefix=/usr DESTDIR="$BATS_TEST_TMPDIR/dest" uninstall
  [ -z "$(find "$BATS_TEST_TMPDIR/dest" ! -type d)" ]
}

@test "every option of a command stands in its man page" {
  for program in bakeslab renderslab; do
    for command in $(commands "$PREFIX/bin/$program"); do
      page=$PREFIX/share/man/man1/$program-$command.1
      options=$("$PREFIX/bin/$program" "$command" --help | grep -oE -- '--[a-z][a-z-]*' | sort -u)
      [ -n "$options" ]
      for option in $options; do
        sed 's/\\-/-/g' "$page" | grep -qF -- "$option" || { echo "$page lacks $option"; false; }
      done
    done
  done
}

@test "man pages are clean roff" {
  for page in "$PREFIX"/share/man/man?/*; do
    # groff may be missing on a small machine; help2man and scdoc do not need it.
    command -v groff >/dev/null || skip "no groff"
    run groff -man -Tutf8 -ww -z "$page"
    [ -z "$output" ]
  done
}

@test "the installed program finds its include files and bakes" {
  cd "$BATS_TEST_TMPDIR"
  cp "$ROOT/lamps/parabolic.pov" .
  unset CANNED_INCLUDE
  "$PREFIX/bin/bakeslab" bake parabolic.pov -o lamp.tif --uv 2x2 --st 4x4 --rays 1
  "$PREFIX/bin/bakeslab" info lamp.tif
}

@test "the reader in light-slab(5) compiles and agrees with the program" {
  cd "$BATS_TEST_TMPDIR"
  sed -n '/^#include <jansson/,/^}/p' "$ROOT/bakeslab/light-slab.5.scd" | sed 's/\\\\/\\/g' >reader.c
  gcc -Wall -Wextra -Werror reader.c -o reader -ltiff -ljansson
  cp "$ROOT/lamps/parabolic.pov" .
  "$PREFIX/bin/bakeslab" bake parabolic.pov -o lamp.tif --uv 4x4 --st 16x16 --rays 1
  # At the brightest sample: the rectangle is 20 x 20 in y = 0, shining down, the
  # window 3 x 3, with 4 x 4 and 16 x 16 samples.
  read -r i j k l < <("$PREFIX/bin/bakeslab" info lamp.tif |
    sed -n 's/^ *peak .*at sample (\([0-9]*\), \([0-9]*\), \([0-9]*\), \([0-9]*\))$/\1 \2 \3 \4/p')
  read -r red green blue < <(./reader lamp.tif "$i" "$j" "$k" "$l")
  awk -v i="$i" -v j="$j" -v k="$k" -v l="$l" 'BEGIN {
    printf "%.9g 0 %.9g %.9g -1 %.9g\n", ((i + .5) / 4 - .5) * 20, ((j + .5) / 4 - .5) * 20,
      ((k + .5) / 16 - .5) * 3, ((l + .5) / 16 - .5) * 3 }' | "$PREFIX/bin/bakeslab" lookup lamp.tif >looked
  awk -v r="$red" -v g="$green" -v b="$blue" '
    function near(x, y) { return x - y < 1e-3 * y && y - x < 1e-3 * y }
    { exit !(r > 0 && near($1, r) && near($2, g) && near($3, b)) }' looked
}
