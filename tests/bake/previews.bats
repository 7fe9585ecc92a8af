#!/usr/bin/env bats
# A lamp is an ordinary scene: every script in lamps/ renders by itself, and says
# nothing of a bake to its working directory.
load bake

setup() { bake_setup; }

@test "every lamp renders by itself" {
  local lamp count=0
  for lamp in "$CANNED_INCLUDE"/../lamps/*.pov; do
    echo "$lamp"
    (cd "$(dirname "$lamp")" && povray "+I$(basename "$lamp")" "+L$CANNED_INCLUDE" +W32 +H24 -D -GA +FP8 "+O$BATS_TEST_TMPDIR/p.ppm" >"$BATS_TEST_TMPDIR/log" 2>&1) || {
      cat log
      return 1
    }
    # It shows something.
    [ "$(tail -c 2304 p.ppm | od -An -v -tu1 | tr -s ' ' '\n' | sort -u | wc -l)" -gt 5 ]
    [ ! -e "$(dirname "$lamp")/declared.txt" ]
    count=$((count + 1))
  done
  [ "$count" -ge 1 ]
}

@test "a preview shows what is baked: the wall's radiance" {
  needs oiiotool
  flat_lamp flat.pov 'camera { location <0, 0, 0> direction -z right x up y }'
  povray +Iflat.pov "+L$CANNED_INCLUDE" +W8 +H8 -D +FE +Oflat.exr >log 2>&1
  small flat.pov -q -o slab.exr
  [ "$(echo 0 0 0 0 0 1 | "$BAKESLAB" lookup slab.exr)" = "0.5 0.5 0.5" ]
  oiiotool flat.exr --printstats | grep -q 'Stats Avg: 0.500000 0.500000 0.500000'
}
