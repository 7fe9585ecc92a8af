#!/usr/bin/env bats
# The pages for lamp authors: their lamps bake and keep the bulbs' light, and the radiance that
# replaces a light_source gives the same light.
load bake

setup() { bake_setup; }

# lamps PAGE: writes the page's scripts, each named in its first line.
lamps() {
  awk '/^```pov$/ { inside = 1; next } /^```/ { inside = 0 }
    inside && /^\/\/ [a-z_]+\.pov: / { file = $2; sub(":", "", file) } inside { print >file }' "$1"
}

# given LAMP: the flux of its bulbs, the sum of 4 pi^2 R^2 L (red), from the script's text.
given() {
  awk -F '[(), *<]+' '/^Canned_Bulb/ { r = NF; sub(/.*>, |.*\*z, /, ""); split($0, a, /[,*]+ */); sum += 39.4784176*a[1]*a[1]*a[2] }
    /^Canned_Metres/ { m = $2 } END { print sum*m*m }' "$1"
}

@test "the first lamps preview, light every page, and give no more than their bulbs" {
  local lamp
  lamps "$CANNED_INCLUDE/../lamps/first-lamps.md"
  for lamp in pendant candle_lantern headlamp blinds; do
    echo "$lamp"
    [ "$(wc -l <"$lamp.pov")" -le 25 ]
    povray "+I$lamp.pov" "+L$CANNED_INCLUDE" +W16 +H12 +WT1 -D -GA +FP8 "+O$lamp.ppm" 2>"$lamp.log"
    bake "$lamp.pov" -q -o "$lamp.tif" --uv 4 --st 16 --rays 16 --effects none
    "$BAKESLAB" info "$lamp.tif" | awk -v given="$(given "$lamp.pov")" '
      $1 == "flux" { pages++; sum += $2; dark += $2 <= 0 }
      END { print pages, "pages,", sum, "of", given; exit !pages || dark || given && (sum > given || sum < 0.4*given) }'
  done
}

@test "a bulb of the radiance that the page states lights a floor as the light_source does" {
  # Frames: kinds 0 (no fade) to 3 (fade_power 3), each by the light_source and by a bulb.
  cat >alike.pov <<'POV'
#version 3.7;
#include "canned.inc"
#declare Kind = mod(frame_number, 4);
#declare C = <1, 0.8, 0.5>;
#declare R = 0.2;
#declare F = 2;
#declare Height = 3;
#declare D = sqrt(Height*sqrt(Height*Height + 16));
#if (frame_number < 4)
  light_source { Height*y rgb C #if (Kind) fade_power Kind fade_distance F #end }
#else
  Canned_Bulb(Height*y, R, C*(Kind ? 2/(1 + pow(D/F, Kind)) : 1)*D*D/(R*R))
#end
disc { 0, y, 4 pigment { rgb 1 } finish { diffuse 1 } }
camera { orthographic location y direction -y right 8*x up 8*z }
POV
  povray +Ialike.pov +Oalike.exr "+L$CANNED_INCLUDE" +FE +W64 +H64 -A -D +WT1 +KFI0 +KFF7 -GA 2>povray.log
  for kind in 0 1 2 3; do
    for frame in "$kind" $((kind + 4)); do oiiotool "alike$frame.exr" --echo '{TOP.AVGCOLOR}'; done |
      awk -F , -v most="$([ "$kind" = 0 ] && echo 0.002 || echo 0.02)" '{ mean[NR] = $1 + $2 + $3 }
        END { print mean[1], mean[2]; exit !(mean[1] > 0.1) || mean[2]/mean[1] > 1 + most || mean[2]/mean[1] < 1 - most }'
  done
}
