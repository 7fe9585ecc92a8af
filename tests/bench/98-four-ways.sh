#!/usr/bin/env bash
# One lamp four ways: its script, rays drawn from it, pictures of it from 200 places, its far field.
# Each becomes a slab and lights the same floor, near and far; the reference is a fine bake. Errors
# are relative RMS over the floor. Then the pictures of a lamp of known radiance.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
# shellcheck source=tests/cli/poses.bash
. "$root/tests/cli/poses.bash"
mkdir -p four-ways
cd four-ways
fixtures=$root/tests/bake/lamps

# lamp NAME WIDTH SLOPE TEXT: the script of a lamp with a square aperture in centimetres, at the
# origin, open below; directly lit only.
lamp() {
  cat >"$1.pov" <<POV
#version 3.7;
#include "canned.inc"
#include "known.inc"
Canned_Lamp("$1")
Canned_Metres_Per_Unit(0.01)
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <$2, 0, 0>, <0, 0, $2>, <0, -1, 0>, <-$3, $3, -$3, $3>, 0)
$4
POV
}

# baked LAMP NAME OPTION...
baked() { spend "$2" "$BAKESLAB" bake "$1.pov" -o "$2.exr" -L "$fixtures" --window declared -q "${@:3}"; }

# pictures LAMP WIDTH COUNT PIXELS: posed pictures from 3 apertures away, below NAME-pictures/
pictures() {
  mkdir -p "$1-pictures"
  cd "$1-pictures"
  poses "$3" "$(calc %g "3*$2")" "$(calc %g "1.6*$2")" "$4"
  printf '#version 3.7;\n#include "%s.pov"\n#include "cameras.inc"\n' "$1" >pictures.pov
  povray pictures.pov +L.. "+L$fixtures" "+L$CANNED_INCLUDE" +FE +A0.02 +AM1 +R3 -D "+W$4" "+H$4" \
    +KFI1 "+KFF$3" +KI1 "+KF$3" +Opicture.exr >pictures.log 2>&1
  cd ..
}

# imported NAME WIDTH FILE OPTION...: with the lamp's aperture
imported() {
  spend "$1" "$BAKESLAB" import "$3" -o "$1.exr" --unit cm --center 0,0,0 --u "$2,0,0" --v "0,0,$2" \
    --normal 0,-1,0 "${@:4}"
}

# receivers WIDTH APERTURES: 24 x 24 of a floor that far below, as wide as slopes of 1.5 reach
receivers() {
  awk -v width="$1" -v d="$2" 'BEGIN {
    for (n = 0; n < 576; ++n) print ((n%24 - 11.5)/12*(1.5*d + 0.5)*width), -d*width, ((int(n/24) - 11.5)/12*(1.5*d + 0.5)*width), "0 1 0" }'
}

# floor NAME UNIT WIDTH APERTURES: irradiance, the lamp's unit of length being so many of the slab's
floor() { receivers "$3" "$4" | "$RENDERSLAB" irradiance --light "$1.exr scale=$2" | awk '{ print $2 }'; }

# off NAME UNIT WIDTH APERTURES REFERENCE: relative RMS of the floor, in %
off() {
  paste <(floor "$1" "$2" "$3" "$4") <(floor "$5" 1 "$3" "$4") |
    awk '{ d += ($1 - $2)^2; s += $2^2 } END { printf "%.2f", 100*sqrt(d/s) }'
}

# told NAME: the error that the slab says of its import, in %
told() {
  "$BAKESLAB" info --json "$1.exr" |
    jq -r '.pages[0].provenance.import.error // empty | 100*. | tostring' | awk '{ printf "%.2g", $1 }'
}

# compare NAME UNIT WIDTH REFERENCE WHAT
compare() {
  local d errors=() size
  for d in 0.5 1 4 16; do errors+=("$(off "$1" "$2" "$3" "$d" "$4")"); done
  size=$(stat -c %s "$1.exr" | awk '{ printf "%.2f", $1/1e6 }')
  printf '  %-42s %7s %7s %7s %7s %8s %8s %7s\n' "$5" "${errors[@]}" "$(told "$1")" "$(cat "$1.cpu")" "$size"
}

# far_field NAME WIDTH: NAME.ies by the irradiance 1000 apertures away, in metres
far_field() {
  local d
  d=$(calc %g "1000*$2")
  awk -v d="$d" 'BEGIN { r = 3.14159265358979/180
    for (c = 0; c < 360; c += 15) for (g = 0; g <= 90; g += 2.5) {
      x = sin(g*r)*cos(c*r); y = -cos(g*r); z = sin(g*r)*sin(c*r)
      print d*x, d*y, d*z, -x, -y, -z } }' |
    "$RENDERSLAB" irradiance --light fine.exr | awk -v d="$d" -v width="$2" '
    BEGIN { printf "IESNA:LM-63-2002\r\nTILT=NONE\r\n1 -1 1 37 25 1 2 %g %g 0\r\n1 1 0\r\n", width/100, width/100
      for (g = 0; g <= 90; g += 2.5) printf "%g ", g; print ""
      for (c = 0; c <= 360; c += 15) printf "%g ", c; print "" }
    { i = $2*d*d/1e4; if (NR <= 37) first[NR] = i; printf "%.6g ", i }
    END { for (n = 1; n <= 37; ++n) printf "%.6g ", first[n]; print "" }' >"$1.ies"
}

# A tin with a bulb in it; open below, white inside.
lamp tin 12 3 'Canned_Bulb(<0, 5, 0>, 0.6, 5000)
difference { cylinder { <0, 0.01, 0>, <0, 12, 0>, 6 } cylinder { <0, 0, 0>, <0, 11.8, 0>, 5.8 }
  pigment { rgb 0.8 } finish { diffuse 1 } }'
baked tin fine --uv 20 --st 80 --rays 8 --uniform
baked tin script
pictures tin 12 200 48
imported pictures 12 tin-pictures/transforms.json --window -3,3,-3,3
for count in 1e5 1e6; do
  "$TOOLS/slab_rays" fine.exr "$count" 1 >rays.txt
  imported "rays-$count" 12 rays.txt -q
done
rm rays.txt
far_field far 12
spend far "$BAKESLAB" import far.ies -o far.exr -q
heading "One lamp four ways: a tin 12 cm wide with a bulb in it; error of a floor in %, at so many apertures"
printf '  %-42s %7s %7s %7s %7s %8s %8s %7s\n' '' 0.5 1 4 16 told 'CPU s' MB
compare script 1 12 fine 'its script, baked by default'
compare rays-1e5 100 12 fine '1e5 rays'
compare rays-1e6 100 12 fine '1e6 rays'
compare pictures 100 12 fine '200 pictures of 48 x 48 pixels'
compare far 100 12 fine 'its far field (IES, 2.5 x 15 degrees)'

# Known radiance: a glowing sheet behind a filtering one, both with waves of colours.
lamp waves 4 1.5 'Waves(<0, 0, 0>, <4, 0, 0>, <0, 0, 4>, <0, -1, 0>, 3)'
baked waves known --uv 16 --st 32 --rays 4 --uniform
pictures waves 4 200 32
imported waves-pictures 4 waves-pictures/transforms.json --window -1.5,1.5,-1.5,1.5
heading '200 pictures, from random places of a hemisphere, of a lamp of known radiance'
for d in 0.5 3 10; do
  error=$(off waves-pictures 100 4 "$d" known)
  row "floor $d apertures away: error, %" "$error" '<= 3' "$(holds "$error <= 3")"
done
row 'samples that no picture shows' "$(grep -o 'shows .*flux' waves-pictures.log | sed 's/shows //')"
