#!/usr/bin/env bash
# Beams in fog: the torch's and the slide projector's, on lines across the beam, as a camera beside
# it sees them in thin fog (single scattering): by the include in POV-Ray's media, and by the lamp
# itself. POV-Ray has no way to light media by what is seen through lenses but photons. So the
# lamp's own light is summed by rays:
#   1. Fog shines by its scattering times the integral of radiance over directions, at each point.
#   2. Rays of radiance go from points of the aperture (a low-discrepancy sequence) into the lamp,
#      away from points of the fog; each counts as the solid angle of its part of the aperture.
#   3. Sums along the camera's rays are the picture; the difference of two halves of the
#      sequence tells its noise.
# Then the projector's beam in a small picture with fewer lights and fewer samples of media.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p fog
cd fog
points=400 columns=24 rows=24 # points of the aperture; fog along and across a line
most=(99 4) # lights a side, at most

# slab LAMP: baked as its header says, with its include.
slab() {
  local flags
  flags=$(sed -n 's|^// Bake: bakeslab bake .* -o [^ ]*||p' "$root/lamps/$1.pov")
  # shellcheck disable=SC2086
  [ -e "$1.tif" ] || "$BAKESLAB" bake "$root/lamps/$1.pov" -o "$1.tif" -q $flags
  "$BAKESLAB" include "$1.tif" -o "$1.inc" -q
}

# scenes LAMP EFFECTS SLOPE FRONT WIDTH DISTANCE...: LAMP-whole.pov, a frame for each point of the
# aperture and distance; LAMP-canned.pov, a frame for each distance. SLOPE: half of what is seen.
scenes() {
  local lamp=$1 effects=$2 slope=$3 front=$4 width=$5 macro
  shift 5
  macro=$(grep -m1 -oE '[A-Za-z0-9_]+_Canned\b' "$lamp.inc")
  cat >"$lamp-whole.pov" <<POV
#version 3.7;
#declare Canned_Bake_Effects = "$effects";
#declare Canned_Bake_Photons = 20000;          // for the torch's rim, in each frame
#include "$lamp.pov"
#declare Away = array[$#] { $(echo "$*" | tr ' ' ',') };
#declare N = mod(frame_number - 1, $points);
#declare D = Away[floor((frame_number - 1)/$points)];
#declare Q = $width*<mod(0.5 + N*0.7548776662, 1) - 0.5, mod(0.5 + N*0.569840291, 1) - 0.5, 0> + $front*z;
camera { perspective location Q direction Q - D*z right -2*$slope*D*x up -2*$slope*D*y }
POV
  cat >"$lamp-canned.pov" <<POV
#version 3.7;
global_settings { assumed_gamma 1 }
#declare ${macro%_Canned}_Lights = Lights;
#include "$lamp.inc"
object { $macro(1, 1) }
#declare Away = array[$#] { $(echo "$*" | tr ' ' ',') };
#declare D = Away[frame_number - 1];
camera { orthographic location <2*D, 0, D> direction -x right 1e-6*z up 2*$slope*D*y }
box {
  <-$slope*D, -2*D, 0.9*D>, <$slope*D, 2*D, 1.1*D>
  hollow no_shadow pigment { rgbt 1 }
  interior { media { scattering { 1, 1/D extinction 0 } method 2 intervals 1 samples 256 jitter 0 } }
}
POV
}

# frames NAME COUNT WIDTH OPTION...: NAME.txt, all pixels of an animation, frame below frame.
frames() {
  local name=$1 count=$2 width=$3
  shift 3
  rm -f "$name"[0-9]*.exr
  spend "$name" povray "+I$name.pov" "+O$name.exr" +FE -A +WT1 "+W$width" "+H$rows" -D "+KFF$count" \
    "+L$CANNED_INCLUDE" "+L$root/lamps" "$@"
  oiiotool "$name"[0-9]*.exr --mosaic "1x$count" -d float -o all.exr
  oiiotool --dumpdata all.exr | tr -d '(),:' >"$name.txt"
  rm "$name"[0-9]*.exr
}

# Lines of the lamp's own light: "frame row all one-half other-half", green.
lines() {
  awk -v slope="$3" -v front="$4" -v width="$5" -v away="${*:6}" -v points="$points" -v columns="$columns" -v rows="$rows" '
    BEGIN { split(away, d, " ") }
    $1 == "Pixel" {
      f = int($3/rows); j = $3 % rows; k = int(f/points); n = f % points; D = d[k + 1]
      x = (2*($2 + 0.5)/columns - 1)*slope*D; y = (1 - 2*(j + 0.5)/rows)*slope*D
      a = 0.5 + n*0.7548776662; b = 0.5 + n*0.569840291
      a = width*(a - int(a) - 0.5); b = width*(b - int(b) - 0.5); h = D - front
      r2 = (x - a)^2 + (y - b)^2 + h*h
      # The picture of a medium of scattering 1/D, which POV-Ray lights by 1/pi of the sum.
      sum[k, j, n % 2] += $5*h/(r2*sqrt(r2))*width*width/points*2*slope/columns/3.14159265
    }
    END { for (k = 0; (k + 1) in d; ++k) for (j = 0; j < rows; ++j)
      print k, j, sum[k, j, 0] + sum[k, j, 1], 2*sum[k, j, 0], 2*sum[k, j, 1] }' "$1.txt"
}

# compare LAMP LIGHTS DISTANCE...: rows of the table.
compare() {
  local lamp=$1 way="at most $2 a side"
  [ "$2" -le 16 ] || way=all
  shift 2
  awk '$1 == "Pixel" { print $5 }' "$lamp-canned.txt" | paste -d ' ' "$lamp-lines.txt" - |
    awk -v lamp="$lamp, $way" -v away="$*" '
      { all[$1] += $3; canned[$1] += $6; half[$1] += $4 - $5; s[$1] += $3^2; e[$1] += ($6 - $3)^2; n[$1] += ($4 - $5)^2/4 }
      END { m = split(away, d, " "); for (k = 0; k < m; ++k)
        printf "  %-26s %9g %+9.2f %8.2f %10.2f %8.2f\n", lamp, d[k + 1], 100*(canned[k]/all[k] - 1), 100*sqrt((half[k]/2)^2)/all[k],
          100*sqrt(e[k]/s[k]), 100*sqrt(n[k]/s[k]) }'
}

beam() {
  local lamp=$1 n
  slab "$lamp"
  scenes "$@"
  frames "$lamp-whole" "$((points * ($# - 5)))" "$columns"
  lines "$lamp-whole" "${@:2}" >"$lamp-lines.txt"
  for n in "${most[@]}"; do
    frames "$lamp-canned" "$(($# - 5))" 1 "Declare=Lights=$n"
    compare "$lamp" "$n" "${@:6}"
  done
}

heading 'Beams in fog, canned against the lamp itself, on lines across the beam; % (noise of the latter beside)'
printf '  %-26s %9s %9s %8s %10s %8s\n' 'lamp, lights' distance 'light' noise RMS noise
beam torch caustics 0.5 0 30 250 500 1000 2000
beam slide_projector '' 0.2 1 4.5 50 100 150 200

# fog NAME LIGHTS MEDIA WORDS: the projector's beam from its side, in a container with these words.
fog() {
  cat >"$1.pov" <<POV
#version 3.7;
global_settings { assumed_gamma 1 }
#declare Slide_Projector_Lights = $2;
#include "slide_projector.inc"
object { Slide_Projector_Canned(1, 100) }
camera { location <-178, 48, -60> right 1.6*x angle 60 look_at <0, 0, 100> }
box {
  <-40, -28, 50>, <40, 28, 199>                  // from ten apertures on
  hollow pigment { rgbt 1 } $4
  interior { media { scattering { 1, 0.001 extinction 0 } intervals 1 jitter 0 $3 } }
}
POV
  spend "$1" povray "+I$1.pov" "+O$1.exr" +FE -A +WT1 +W160 +H100 -D
}

# against NAME: RMS of the difference from fine.exr over the RMS of that, in %. Statistics are printed
# with six decimals: a thousandfold picture keeps its digits.
against() {
  oiiotool "$1.exr" fine.exr --sub --mulc 1000 --dup --mul -d float -o square.exr \
    fine.exr --mulc 1000 --dup --mul -d float -o all.exr
  paste <(oiiotool --stats square.exr) <(oiiotool --stats all.exr) |
    awk '/Stats Avg/ { for (k = 1; k <= NF/2; ++k) if ($k == "Avg:") { a = $(k + 2); b = $(k + 2 + NF/2) } printf "%.2g", 100*sqrt(a/b) }'
}

heading "The projector's beam, 160x100, against all 8 lights a side and 200 samples: error in %, CPU seconds"
fog fine 8 'method 2 samples 200' no_shadow
printf '  %-66s %8.2g %8s\n' '8 lights a side, method 2 samples 200' 0 "$(cat fine.cpu)"
while IFS=: read -r number media words; do
  fog try "$number" "$media" "$words"
  printf '  %-66s %8s %8s\n' "$number lights a side, $media $words" "$(against try)" "$(cat try.cpu)"
done <<'WAYS'
8:method 2 samples 40:no_shadow
4:method 2 samples 40:no_shadow
4:method 2 samples 40:
4:method 2 samples 20:no_shadow
4:method 2 samples 10:no_shadow
4:method 3 samples 20:no_shadow
2:method 2 samples 40:no_shadow
WAYS
