#!/usr/bin/env bash
# Scenes lit through the include: against the whole lamp, and with fewer lights.
# $DEMO holds what `make demo` made.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
script="$root/include-pov/demo.sh"

heading "The demo's picture: canned against the whole lamp with its interreflection"
mkdir -p demo
cp "$DEMO"/*.seconds "$DEMO"/canned.exr "$DEMO"/full.exr "$DEMO"/renderslab.exr demo
"$script" compare demo >compare.txt
mean=$(awk '/^mean of/ { print $NF }' compare.txt)
faster=$(calc %.1f "$(cat demo/full.seconds)/$(cat demo/canned.seconds)")
row 'mean, canned over whole' "$mean" '1 +-0.02' "$(holds "$mean > 0.98 && $mean < 1.02")"
row 'CPU, whole over canned' "$faster" '>= 5' "$(holds "$faster >= 5")"
row 'CPU seconds: canned, whole, bake (once for all scenes)' \
  "$(cat demo/canned.seconds), $(cat demo/full.seconds), $(cat demo/bake.seconds)"
sed -n 's/^RMS difference, means of/  RMS difference, means of/p' compare.txt

# The bulb's light alone, so that the truth is known (20-floor.sh): the floor 60 cm below, by
# the include of a default bake, and by the whole lamp with the demo's settings but one bounce.
cat >floor.pov <<POV
#version 3.7;
#ifdef (Full_Lamp)
  #declare Canned_Bake_Effects = "extended_source";
  #include "parabolic.pov"
  global_settings {
$(sed -n '/^ *radiosity {/,/^ *}/p' "$root/include-pov/demo.pov" | sed 's/recursion_limit 3/recursion_limit 1/')
  }
#else
  global_settings { assumed_gamma 1 }
  #default { finish { ambient 0 } }
  #include "bulb.inc"
  object { Parabolic_Canned(1, 1) }
#end
plane { y, -60 pigment { rgb 1 } finish { diffuse 1 ambient 0 } no_radiosity }
camera { orthographic location -y direction -y right 160*x up 160*z }
POV
"$BAKESLAB" include adaptive16.exr -o bulb.inc
picture canned floor.pov 256
picture whole floor.pov 256 Declare=Full_Lamp=1
heading "A floor under the bulb's light alone, 256x256 pixels, against the lamp itself (means of 4x4)"
for name in canned whole; do
  read -r error mean < <("$TOOLS/floor" image truth.bin "$name.exr")
  row "$name lamp: RMSE %, mean, CPU seconds" "$error, $mean, $(cat "$name.cpu")"
done

heading "The same floor by fewer lights"
printf '  %-8s %8s %8s %15s %15s   %s\n' lights 'CPU s' ratio 'from lamp, %' 'from 16x16, %' \
  'header, % at 2 and 4 widths (the floor is 3 away)'
for n in 16 8 4 1; do
  name=lights$n
  picture "$name" floor.pov 256 "Declare=Parabolic_Lights=$n"
  read -r error _ < <("$TOOLS/floor" image truth.bin "$name.exr")
  read -r change _ < <("$TOOLS/floor" image truth.bin "$name.exr" lights16.exr)
  stated=$(awk -v lights="${n}x$n" '$1 == "//" && $2 == lights { print $8 ", " $9 }' bulb.inc)
  printf '  %-8s %8s %8s %15s %15s   %s\n' "${n}x$n" "$(cat "$name.cpu")" \
    "$(calc %.3f "$(cat "$name.cpu")/$(cat lights16.cpu)")" "$error" "$change" "$stated"
done
