#!/usr/bin/env bats
# Groups of bulbs apart: one bake gives the light of each, which add up to the lamp's.
bats_require_minimum_version 1.5.0
load bake

setup() { cd "$BATS_TEST_TMPDIR" || return; }

# lamp FILE TEXT: a white box, open towards -y, with these sources in it.
lamp() {
  cat >"$1" <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("two")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, 12*x, 12*z, -y, <-3, 3, -3, 3>, 0)
difference { box { <-6, 0.01, -6>, <6, 12, 6> } box { <-5.8, 0, -5.8>, <5.8, 11.8, 5.8> } pigment { rgb 0.8 } finish { diffuse 1 } }
LAMP
  printf '%s\n' "$2" >>"$1"
}
warm='Canned_Bulb(<-3, 5, 0>, 1, <50, 30, 10>)'
cold='Canned_Bulb(<3, 5, 1>, 1, <20, 30, 50>) box { <-5, 9, -5>, <5, 9.2, 5> pigment { rgb 1 } finish { emission rgb Canned_Lit(0.5) diffuse 0 } }'
both="Canned_Channel(\"warm\") $warm Canned_Channel(\"cold\") $cold"

# rays: 200 of them, through the aperture, always the same.
rays() { awk 'BEGIN { srand(1); for (n = 0; n < 200; ++n) print 11*rand() - 5.5, 0, 11*rand() - 5.5, 5*rand() - 2.5, -1, 5*rand() - 2.5 }'; }

# close TOLERANCE A B: the numbers of two files, relative to the largest.
close() {
  paste "$2" "$3" | awk -v most="$1" '{ for (c = 1; c <= 3; ++c) { d = $c - $(c + 3); if (d < 0) d = -d; if (d > worst) worst = d
    if ($c > peak) peak = $c } } END { print worst/peak; exit !(peak > 10 && worst <= most*peak) }'
}
look() { rays | "$BAKESLAB" lookup "$1"; }

@test "channels add up to the lamp baked whole; each is what its bulbs alone give" {
  lamp two.pov "$both"
  lamp whole.pov "$warm $cold"
  lamp warm.pov "$warm ${cold//<20, 30, 50>/0}"
  sed -i 's/Canned_Lit(0.5)/0/' warm.pov
  for one in two whole warm; do
    bake "$one.pov" -o "$one.exr" --uv 4 --st 16 --centre --precision float -q
    look "$one.exr" >"$one"
  done
  # POV-Ray's pictures are half floats
  close 2e-4 whole two
  echo 0 -9 0 0 1 0 >receiver
  "$RENDERSLAB" irradiance --light 'two.exr gain.cold=0' <receiver >two.warm
  "$RENDERSLAB" irradiance --light warm.exr <receiver >warm.warm
  paste two.warm warm.warm | awk '{ for (c = 1; c <= 3; ++c) if ($c < 0.1 || $c/$(c + 3) > 1.0002 || $c/$(c + 3) < 0.9998) exit 1 }'
  run "$BAKESLAB" info two.exr
  [[ $output == *"page 2 of 2"*"channel       cold"*"two.exr: channel warm: flux "*"two.exr: channel cold: flux "* ]]
  run "$BAKESLAB" check two.exr
  [[ $output != *"is there twice"* ]]
}

@test "gains are linear" {
  lamp two.pov "$both"
  bake two.pov -o two.tif --uv 2 --st 8 --rays 1 -q 2>/dev/null
  sum() { echo 1 -20 2 0 1 0 | "$RENDERSLAB" irradiance --light "two.tif gain=1,2,3 $1"; }
  sum 'gain.warm=1 gain.cold=0' >warm
  sum 'gain.cold=1 gain.warm=0' >cold
  sum 'gain.warm=0.3 gain.cold=1.7' >both
  paste warm cold both | awk '{ for (c = 1; c <= 3; ++c) { off = (0.3*$c + 1.7*$(c + 3))/$(c + 6) - 1; if (off*off > 1e-12) exit 1 } }'
  run ! sum 'gain.wram=1'
  [[ $output == *"gain.wram=: two.tif has no channel wram: it has warm, cold" ]]
  run ! sum 'gain.warm=-1'
  [[ $output == *"gain.warm=-1, must not be negative" ]]
  run ! sum 'gain.warm=1 gain.warm=2'
  [[ $output == *"gain.warm=G is there twice" ]]
  "$BAKESLAB" include two.tif -o two.inc
  printf 'v -9 -9 -9\nv 9 -9 -9\nv 0 -9 9\nf 1 2 3\n' >floor.obj
  "$RENDERSLAB" pov floor.obj --light 'two.tif gain.cold=0.5' --camera 'from=0,-2,-9 at=0,-9,0' --repair -o x.pov
  [[ $(<x.pov) == *$'Two_Canned_Channel("warm", 1)\nTwo_Canned_Channel("cold", 0.5)\nobject { Two_Canned('* ]]
}

@test "channels that cannot be: one line each" {
  lamp x.pov "Canned_Channel(\"warm\") $warm Canned_Channel(\"empty\")"
  refused 1 'x.pov: Canned_Channel\("empty"\): nothing after it gives light' x.tif small x.pov -o x.tif
  lamp x.pov "$warm Canned_Channel(\"cold\") $cold"
  refused 1 'Canned_Channel: 1 of Canned_Bulb.*belong to none' x.tif small x.pov -o x.tif
  lamp x.pov "Canned_Channel(\"warm\") $warm Canned_Channel(\"Warm\") $cold"
  refused 1 'Canned_Channel\("Warm"\): differs from "warm" in capitals only' x.tif small x.pov -o x.tif
  lamp x.pov "Canned_Channel(\"wa rm\") $warm"
  refused 1 'Canned_Channel: the name "wa rm" is not' x.tif small x.pov -o x.tif
  lamp x.pov "$both sphere { y, 1 pigment { rgb 1 } finish { emission 1 } }"
  refused 1 'x.pov: some of its light belongs to no Canned_Channel' x.tif small x.pov -o x.tif
}

@test "a channel whose light does not leave is told" {
  lamp x.pov "Canned_Channel(\"warm\") $warm Canned_Channel(\"far\") Canned_Bulb(<30, 9, 0>, 1, 9)"
  run small x.pov -o x.tif -q
  [ "$status" -eq 0 ]
  [[ $output == *'x.pov: warning: the channel "far" gives no light that leaves through the pages'* ]]
}
