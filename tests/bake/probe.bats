#!/usr/bin/env bats
# What a bake finds out by itself: effects, windows, resolution.
load bake

setup() { bake_setup; }

# lamp FILE TEXT: one slab, 2 wide, and a lamp in it; no Canned_Needs.
lamp() {
  cat >"$1" <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("probed")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
LAMP
  printf '%s\n' "$2" >>"$1"
}
white_box='Canned_Bulb(<0, 0, -1.5>, 0.3, 5)
difference { box { <-1.4, -1.4, -2.4>, <1.4, 1.4, 0> } box { -1.2, <1.2, 1.2, 1> translate -0.8*z } pigment { rgb 0.5 } finish { diffuse 1 } }'

# effect FILE WORD: what was decided of it.
effect() { "$BAKESLAB" info --json "$1" | tr '\n' ' ' | sed "s/.*\"$2\": \"\([^\"]*\)\".*/\1/"; }
flux() { "$BAKESLAB" info "$1" | awk '$1 == "flux" { print $2 }'; }
field() { "$BAKESLAB" info --json "$1" | tr -d ' \n' | sed "s/.*\"$2\":\[\([^]]*\)\].*/\1/" | tr ',' ' '; }
# near A B PART: two numbers agree.
near() { awk -v a="$1" -v b="$2" -v p="$3" 'BEGIN { print a, b; exit !(a - b <= p*b && b - a <= p*b) }'; }

@test "a lamp that calls for nothing gets nothing, and the same samples as without a probe" {
  sed /Canned_Needs/d flat.pov >lamp.pov
  small lamp.pov -q -o x.exr
  small lamp.pov -q -o y.exr --effects none
  same x.exr y.exr
  for word in interreflection caustics extended_source deep_trace; do
    effect x.exr "$word"
    [[ $(effect x.exr "$word") == "off: flux +0 %, 0 % RMS, "* ]]
    [ "$(effect y.exr "$word")" = off ]
  done
}

@test "a white box calls for interreflection, as many bounces as change it, and nothing else" {
  lamp box.pov "$white_box"
  bake box.pov -q -o auto.exr --uv 4 --st 8 --rays 4
  for word in interreflection caustics extended_source deep_trace; do effect auto.exr "$word"; done
  [[ $(effect auto.exr interreflection) =~ ^on:\ flux\ \+[1-9].*\;\ [2345]\ bounces,\ (more|not) ]]
  [[ $(effect auto.exr caustics) == off:* && $(effect auto.exr deep_trace) == off:* ]]
  bake box.pov -q -o all.exr --uv 4 --st 8 --rays 4 --effects all
  near "$(flux auto.exr)" "$(flux all.exr)" 0.04 # all has two bounces
  # Canned_Needs is believed, unless a probe is asked for.
  sed '/Canned_Lamp/a Canned_Needs("")' box.pov >needs.pov
  bake needs.pov -q -o needs.exr --uv 4 --st 8 --rays 4
  [ "$(effect needs.exr interreflection)" = off ]
  bake needs.pov -q -o probe.exr --uv 4 --st 8 --rays 4 --effects probe --jobs 1
  same probe.exr auto.exr
}

@test "a bulb close to a blind calls for an extended source" {
  # A disc hides the bulb's centre from the wall behind it, but not its rim.
  lamp blind.pov 'Canned_Bulb(<0, 0, -2>, 0.5, 5)
    disc { <0, 0, -2.7>, z, 0.45 pigment { rgb 0 } }
    plane { z, -4 pigment { rgb 0.8 } finish { diffuse 1 } }'
  bake blind.pov -q -o x.exr --uv 2 --st 4 --rays 1 --effect-threshold 0.002
  effect x.exr extended_source
  [[ $(effect x.exr extended_source) =~ ^on:.*\;\ (5|9|17)\ lights\ a\ side ]]
}

@test "deep glass calls for a deeper trace, taken as far as it matters" {
  # Each pane takes two levels; 40 of them are more than 30 levels, and less than 120.
  lamp panes.pov '#for (K, 1, 40)
      box { <-9, -9, -0.04*K>, <9, 9, -0.04*K + 0.02> pigment { rgbf 1 } interior { ior 1.2 } }
    #end
    plane { z, -2 pigment { rgb 1 } finish { emission 1 } }'
  bake panes.pov -q -o x.exr --uv 2 --st 4 --rays 1
  effect x.exr deep_trace
  [[ $(effect x.exr deep_trace) =~ ^on:.*\;\ 120\ levels ]]
  [ "$(echo 0 0 0 0 0 1 | "$BAKESLAB" lookup x.exr | awk '{ print ($1 > 0.1) }')" -eq 1 ]
}

@test "photons that all miss: told, and baked without; refused where caustics are asked for by name" {
  lamp globe.pov 'Canned_Bulb(<0, 0, -2>, 0.2, 5)
    difference { sphere { <0, 0, -2>, 1 } sphere { <0, 0, -2>, 0.9 } pigment { rgbf 1 } interior { ior 1.5 } photons { target refraction on } }
    plane { z, -4 pigment { rgb 0.8 } finish { diffuse 1 } }'
  run small globe.pov -q -o x.exr
  echo "$output"
  [ "$status" -eq 0 ]
  [[ $output =~ "globe.pov: warning: goes without caustics: with them POV-Ray shot "[0-9]+" photons" ]]
  [[ $(effect x.exr caustics) == off:* ]]
  # An extended source shoots beside its centre; a light_source never does.
  sed 's/Canned_Bulb.*/light_source { <0, 0, -2> 5 }/' globe.pov >point.pov
  small point.pov -q -o all.exr --effects all
  [ "$(effect all.exr caustics)" = off ]
  refused 1 'globe.pov: caustics: POV-Ray shot [0-9]+ photons' y.tif small globe.pov -o y.tif --effects caustics
}

@test "photons that matter: tried with twice as many, and what has not converged is told" {
  # A lens that gathers a bulb's light in a narrow spot.
  lamp lens.pov 'Canned_Bulb(<0, 0, -4>, 0.2, 50)
    sphere { <0.01, 0, -7>, 1 pigment { rgbf 1 } interior { ior 1.5 } photons { target refraction on } }
    plane { z, -9 pigment { rgb 0.8 } finish { diffuse 1 } }'
  run bake lens.pov -q -o x.exr --uv 2 --st 4 --rays 1 --effect-threshold 0.01
  echo "$output"
  [ "$status" -eq 0 ]
  effect x.exr caustics
  [[ $(effect x.exr caustics) =~ ^on:.*photons,\ (twice\ as\ many\ would\ change|not\ converged) ]]
  [[ ! $(effect x.exr caustics) =~ "not converged" || $output =~ "caustics on: "*"not converged" ]]
}

@test "--window auto keeps the light and drops the dark; a dark page stays as it is" {
  # A round beam of half angle 0.2 about the slope 0.3.
  lamp beam.pov 'box { <-50, -50, -101>, <50, 50, -100> pigment { function { select(sqrt(pow(x + 30, 2) + y*y) - 20, 1, 1, 0) } color_map { [0.5 rgb 0] [0.5 rgb 1] } } finish { emission 1 } }
    Canned_Slab(<0, 0, 5>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
    box { <-3, -3, 4>, <3, 3, 4.1> pigment { rgb 0 } }'
  bake beam.pov -q -o wide.exr --uv 2 --st 64 --rays 16
  bake beam.pov -q -o fit.exr --uv 2 --st 64 --rays 16 --window auto
  "$BAKESLAB" info fit.exr
  "$BAKESLAB" info fit.exr | awk '/st window/ && !seen++ { if ($3 < -0.1 || $3 > 0.1 || $4 < 0.5 || $4 > 0.75 ||
    $6 < -0.45 || $6 > -0.2 || $7 < 0.2 || $7 > 0.45) exit 1 }'
  near "$(flux fit.exr | head -n 1)" "$(flux wide.exr | head -n 1)" 0.005
  "$BAKESLAB" info fit.exr | grep -q 'window  *page 1: .* of the declared -1 to 1, -1 to 1; page 2: 100 %'
}

@test "--tolerance: fewer samples where the light is smooth, and the error it promises" {
  lamp smooth.pov 'plane { z, -2 pigment { rgb 1 } finish { emission 1 } }'
  lamp sharp.pov 'plane { z, -2 pigment { checker rgb 0 rgb 1 scale 0.7 } finish { emission 1 } }'
  bake smooth.pov -q -o smooth.exr --rays 2 --tolerance 0.05
  bake sharp.pov -o sharp.exr --tolerance 0.05 2>talk.txt
  cat talk.txt
  count() { "$BAKESLAB" info "$1" | awk '$1 == "samples" && $3 == "x" { print $2*$4*$6*$8 + 0 }'; }
  echo "$(count smooth.exr) $(count sharp.exr)"
  [ "$(($(count smooth.exr) * 3))" -lt "$(count sharp.exr)" ]
  # Not fewer positions than rays need, however far away: a bulb is met by few places of an aperture.
  lamp bulb.pov 'Canned_Bulb(-1.5*z, 0.5, 10)'
  bake bulb.pov -q -o far.exr --tolerance 0.02 --for-distance 300
  bake bulb.pov -q -o fine.exr --uv 16 --st 32 --rays 16
  [[ $(field far.exr samples) == "4 4 "* ]]
  near "$(flux far.exr)" "$(flux fine.exr)" 0.02
  grep -q "note: the slab's own error is about 0.0[0-9]* (tolerance 0.05)" talk.txt
  awk '/own error/ { exit !($10 > 0 && $10 < 1.3*0.05) }' talk.txt
  # What is given stays given.
  bake sharp.pov -q -o given.exr --rays 2 --tolerance 0.05 --uv 4x3
  [[ $(field given.exr samples) == "4 3 "* ]]
}

@test "--for-distance puts the st plane where a lamp is in focus; the light there stays" {
  # A mirror that is a part of an ellipsoid makes an image of a glowing ball at 8.
  lamp focus.pov 'sphere { -2*z, 0.1 pigment { rgb 1 } finish { emission 1 } }
difference {
  sphere { 0, 2 scale <1, 1, 5> translate 3*z }
  sphere { 0, 1 scale <1.758, 1.758, 5.3> translate 3*z }
  plane { -z, 0 }
  pigment { rgb 0 } finish { diffuse 0 reflection 1 }
}'
  sed -i 's/<-1, 1, -1, 1>/<-0.6, 0.6, -0.6, 0.6>/' focus.pov
  bake focus.pov -q -o far.exr --rays 4 --uv 16 --st 64 --effects none
  bake focus.pov -q -o x.exr --rays 16 --effects none --tolerance 0.1 --for-distance 8
  "$BAKESLAB" info x.exr | grep 'resolution  *tolerance 0.1 met at 8 lamp units .*; st plane at that distance, the other way '
  [ "$("$BAKESLAB" info x.exr | awk '/st distance/ { print $3 }')" = 8 ]
  near "$(flux x.exr)" "$(flux far.exr)" 0.05
  local receivers='0 0 8 0 0 -1
0.6 -0.4 8 0 0 -1' slab
  for slab in x far; do
    echo "$receivers" | "$RENDERSLAB" irradiance --light $slab.exr | awk '{ print $1 }' >$slab.txt
  done
  paste x.txt far.txt | while read -r x far; do near "$x" "$far" 0.1; done
}

@test "what makes no sense is refused" {
  local option
  for option in '--tolerance 0' '--tolerance nan' '--for-distance -1' '--effect-threshold x' '--window narrow'; do
    # shellcheck disable=SC2086 # an option and its value
    refused 2 "${option% *}" x.tif bake flat.pov -o x.tif $option
  done
}
