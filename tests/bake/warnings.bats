#!/usr/bin/env bats
# What a lamp's author may not mean is told: light that is not in the slab, and why.
bats_require_minimum_version 1.5.0
load bake

setup() { bake_setup; }

# lamp TEXT: one slab, 2 wide, facing +z; x.exr of it; what was said is in $output.
lamp() {
  cat >lamp.pov <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("told")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
LAMP
  printf '%s\n' "$1" >>lamp.pov
  run small lamp.pov -q -o x.exr
  echo "$output"
  [ "$status" -eq 0 ]
}
wall='box { <-9, -9, -2.1>, <9, 9, -2> pigment { rgb 0.8 } finish { diffuse 1 } }'

@test "light_sources are counted, Canned_Bulb's are not" {
  lamp "$wall Canned_Bulb(<0, 0, -1>, 0.1, 9) union { light_source { <0, 1, -1> rgb 1 } sphere { <0, 1, -1>, 0.01 } }
    light_source { <1, 0, -1> rgb 1 area_light x, y, 2, 2 }
    light_group { light_source { <1, 0, -1> rgb 1 } sphere { <1, 0, -1>, 0.1 } }"
  [[ $output == *"lamp.pov: warning: 2 light_sources besides Canned_Bulb's: "*"not in the slab"*"write Canned_Bulb("* ]]
  [[ $output == *"light_sources in a light_group"* ]]
  run "$BAKESLAB" check x.exr
  [[ $output == *"x.exr: warning, by its bake: 2 light_sources besides"* ]]
  lamp "$wall Canned_Bulb(<0, 0, -1>, 0.1, 9) /* light_group { */ // ambient 1"
  [[ $output != *light_* && $output != *ambient* && $output != *writes* ]]
}

@test "light_sources are counted where bulbs are placed often or never; nested comments hold none" {
  lamp "$wall #declare Pair_ = union { Canned_Bulb(<0, 0, -1>, 0.1, 9) } object { Pair_ } object { Pair_ translate x }"
  [[ $output != *light_source* ]]
  [[ $("$BAKESLAB" info x.exr) == *"efficiency not known: POV-Ray does not count a light for each call"* ]]
  lamp "$wall #declare Unused_ = union { Canned_Bulb(<0, 0, -1>, 0.1, 9) } light_source { <0, 1, -1> rgb 1 }"
  [[ $output == *"warning: 1 light_source besides"* ]]
  lamp "$wall Canned_Bulb(<0, 0, -1>, 0.1, 9) /* /* */ light_group { light_source { 0 1 } } */"
  [[ $output != *light_* ]]
}

@test "a lamp without light: told, with the likely reason" {
  lamp 'box { <-9, -9, -1.1>, <9, 9, -1> pigment { rgb 1 } finish { ambient 1 diffuse 0 } }'
  [[ $output == *"gives no light at all: it glows by ambient"* ]]
  lamp 'box { <-9, -9, 1>, <9, 9, 1.1> pigment { rgb 1 } finish { emission 1 diffuse 0 } }'
  [[ $output == *"gives no light at all: there is light on the other side: the normal "* ]]
  run "$BAKESLAB" check --strict x.exr
  [ "$status" -eq 1 ]
  [[ $output == *"by its bake: gives no light at all: there is light on the other side"* ]]
  [[ $output == *"x.exr: warning: gives no light at all"* ]]
  lamp 'sphere { <5, 0, -1>, 1 pigment { rgb 1 } finish { emission 1 diffuse 0 } }'
  [[ $output == *"gives no light at all: its light leaves outside the st window, or is so small"* ]]
  lamp 'Canned_Bulb(<6, 0, -3>, 0.6, 10)'
  [[ $output == *"gives no light at all: its light leaves outside the st window, or is so small"* ]]
  lamp 'Canned_Bulb(<0, 0, -1>, 0.3, 10) box { <-2, -2, -0.1>, <2, 2, -0.05> pigment { rgb 0 } }'
  [[ $output == *"gives no light at all: there is light inside, but something opaque shuts"* ]]
  lamp 'box { <-9, -9, -2>, <9, 9, -1> pigment { rgbt 1 } finish { emission 1 } }'
  [[ $output == *"gives no light at all: what has emission cannot be seen: its pigment is clear"* ]]
  lamp 'sphere { 0, 9 pigment { rgb 0 } } sphere { <0, 0, -30>, 9 pigment { rgb 1 } finish { emission 1 } }
    sphere { <20, 0, -1>, 5 pigment { rgb 1 } finish { emission 1 } }'
  [[ $output == *"gives no light at all: "* && $output != *nan* && $output != *e+02* ]]
  lamp 'light_source { <0, 0, -1> 1 }'
  [[ $output == *"gives no light at all: it is lit by light_sources alone"* ]]
  lamp ''
  [[ $output == *"gives no light at all: nothing in it glows"* ]]
}

@test "things that glow by ambient beside others are told, with their part of the light" {
  # Two halves of the view: ambient 3 and emission 1.
  lamp 'box { <-99, -99, -1.1>, <0, 99, -1> pigment { rgb 1 } finish { ambient 3 diffuse 0 } }
    box { <0, -99, -1.1>, <99, 99, -1> pigment { rgb 1 } finish { emission 1 diffuse 0 } }'
  [[ $output == *"objects glow by ambient (75 % of the light"* ]]
}

@test "files that the script writes are told once" {
  lamp "$wall Canned_Bulb(<0, 0, -1>, 0.1, 9)
#fopen F \"$PWD/first.txt\" write
#write (F, \"1\")
#fclose F
#fopen F \"second.txt\" write
#write (F, \"1\")
#fclose F"
  [ "$(grep -c 'writes files (first.txt is the first)' <<<"$output")" -eq 1 ]
  # What POV-Ray's wrapper writes is none of the script's.
  printf '#!/bin/sh\necho run >>"%s/log.txt"\nexec povray "$@"\n' "$PWD" >logs
  chmod +x logs
  run small lamp.pov -q -o x.exr --povray ./logs
  [[ -s log.txt && $output == *"writes files (first.txt is the first)"* ]]
}

@test "--strict: a warning is a failure, and what was baked is not lost" {
  lamp "$wall Canned_Bulb(<0, 0, -1>, 0.1, 9)"
  rm x.exr
  run small lamp.pov -q -o x.exr --strict # light goes on beyond the window
  echo "$output"
  [ "$status" -eq 1 ]
  [[ $output == *"warning: the pages miss "*"2 warnings, which --strict takes for a failure: no slab is written"* ]]
  [ ! -e x.exr ]
  run small lamp.pov -o x.exr
  [[ $output == *"1 batches, 1 of them found"* ]]
  # What the trial run shows is told before the work.
  lamp "$wall light_source { <0, 0, -1> 1 }"
  rm x.exr
  refused_strict() { small lamp.pov -q -o x.exr --strict; }
  run refused_strict
  [ "$status" -eq 1 ]
  [ ! -e x.exr.partial ]
}

# opal FINISH EFFECTS: a bulb behind a disc of glass.
opal() {
  cat >opal.pov <<LAMP
#version 3.7;
#include "canned.inc"
Canned_Lamp("opal")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-2, 2, -2, 2>, 0)
Canned_Bulb(<0, 0, -1>, 0.3, 1)
$wall
disc { -0.2*z, z, 1 pigment { rgb 0.5 } finish { $1 } }
sphere { <0, 0, -0.5>, 0.1 pigment { rgbt 1 } interior { ior 1.5 } photons { target refraction on } }
LAMP
  run small opal.pov -q --effects "$2" -o x.exr
  echo "$output"
  [ "$status" -eq 0 ]
}
photons='warning: photons (caustics) and a translucent surface (diffuse with two numbers): '

@test "photons with a translucent surface are told, also where less light leaves than bulbs give" {
  opal 'diffuse 0.1, 0.2' caustics
  [[ $output == *"$photons"* && $output != *"as much light leaves"* ]]
  run "$BAKESLAB" check x.exr
  [[ $output == *"by its bake: photons (caustics) and a translucent"* ]]
  opal 'ambient 0 diffuse albedo 0.1 /* , 0 */ , (0.1 + 0.1) phong 1' caustics
  [[ $output == *"$photons"* ]]
  opal 'diffuse 0.1, 0.2' none
  [[ $output != *"$photons"* ]]
  opal 'diffuse 0.1, 0 reflection { 0, 0.1 } emission <0, 0, 0> /* diffuse 1, 1 */' caustics
  [[ $output != *"$photons"* ]]
}

@test "a flux that few rays found is told, and how many would do" {
  lamp 'Canned_Bulb(<0, 0, -1.5>, 0.05, 10)'
  [[ $output == *"gives no light at all: its light is so small that no ray met it"* ]]
  lamp 'Canned_Bulb(<0, 0, -1.5>, 0.15, 10)'
  [[ $output =~ the\ slab\'s\ flux\ is\ known\ to\ [0-9]+\ %\ only.*:\ [0-9]+\ times\ as\ many\ --rays ]]
  run "$BAKESLAB" check x.exr
  [[ $output == *"by its bake: the slab's flux is known to "* ]]
  lamp 'box { <-9, -9, -2.1>, <9, 9, -2> pigment { rgb 1 } finish { emission 1 diffuse 0 } }'
  [[ $output != *"flux is known to"* ]]
}
