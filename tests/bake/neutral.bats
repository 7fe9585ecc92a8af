#!/usr/bin/env bats
# What surrounds a lamp and its user does not change what is baked: gamma, backgrounds, POV-Ray's
# settings; or it is refused by name.
bats_require_minimum_version 1.5.0
load bake

setup() { bake_setup; }

# A wall of radiance 0.5, 0.25, 0.125 that fills half of the view.
wall='box { <-99, -99, -1.1>, <0, 99, -1> pigment { rgb 1 } finish { emission rgb <0.5, 0.25, 0.125> ambient 0 diffuse 0 } }'
# lamp BEFORE AFTER: a script with text before and after canned.inc.
lamp() {
  cat >lamp.pov <<LAMP
$1
#include "canned.inc"
$2
Canned_Lamp("half")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
$wall
LAMP
}

@test "assumed_gamma, versions, backgrounds, rainbows and default textures: the same samples" {
  local gamma
  lamp '#version 3.7;' ''
  small lamp.pov -q -o plain.exr
  [ "$(echo -0.5 0 0 0.25 0 1 | "$BAKESLAB" lookup plain.exr)" = "0.5 0.25 0.125" ]
  for gamma in 1.8 srgb; do
    lamp "#version 3.7; global_settings { assumed_gamma $gamma }" ''
    small lamp.pov -q -o x.exr
    same plain.exr x.exr
    lamp '' "global_settings { assumed_gamma $gamma }"
    small lamp.pov -q -o x.exr
    same plain.exr x.exr
  done
  lamp '#version 3.5; global_settings { assumed_gamma 2.2 }' 'background { rgb 0.3 }'
  small lamp.pov -q -o x.exr
  same plain.exr x.exr
  lamp '' 'rainbow { angle 60 width 120 distance 0.5 direction <0, 0, 1> up y
    color_map { [0 rgbt <1, 0, 0, 0>] [1 rgbt <0, 0, 1, 0>] } }'
  small lamp.pov -q -o x.exr
  same plain.exr x.exr
  lamp '' 'sky_sphere { pigment { gradient y color_map { [0 rgb 1] [1 rgb <0, 0, 1>] } } } background { rgb 2 }
    #default { texture { pigment { rgb 1 } finish { ambient 1 emission 1 reflection 0.5 } } }'
  small lamp.pov -q -o x.exr
  same plain.exr x.exr
  small lamp.pov -q -o x.exr --gain 2^4 # whose filter is in front of the lamp
  same plain.exr x.exr
}

@test "fog and media in all of space are refused, but for previews; media inside the lamp are its own" {
  local haze
  for haze in 'fog { distance 30 color rgb 0.4 }' 'fog { distance 500 color rgb 0 }' 'media { scattering { 1, 0.01 } }' \
    'media { emission 0.001 }' 'fog { fog_type 2 distance 10 color rgb 0.5 fog_offset 1 fog_alt 2 }'; do
    lamp '' "$haze"
    refused 1 'lamp.pov: has fog, or media in all of space' x.exr small lamp.pov -o x.exr
  done
  lamp '' '#ifndef (Canned_Baking) fog { distance 30 color rgb 0.4 } #end'
  small lamp.pov -q -o x.exr
  lamp '' 'sphere { <0, 0, -2>, 0.3 hollow pigment { rgbt 1 } interior { media { emission 1 } } }
    plane { y, -4 pigment { checker rgb 1 rgb 0 scale 0.3 } finish { emission 1 } }'
  small lamp.pov -q -o x.exr
}

@test "povray.ini and povray.conf of the user, by home, by POVINI and in the folder" {
  lamp '' '#include "colors.inc"' # which the system's povray.ini finds
  small lamp.pov -q -o plain.exr
  mkdir -p home/.povray/3.7
  printf 'Grayscale_Output=on\nInitial_Frame=2\nFinal_Frame=4\nQuality=1\nAntialias=on\nDeclare=Canned_Inc_Temp=3.7\n' |
    tee home/.povray/3.7/povray.ini home/.povrayrc own.ini >povray.ini
  printf '[File I/O Security]\nrestricted\n[Permitted Paths]\nread = /nowhere\n' >home/.povray/3.7/povray.conf
  HOME=$PWD/home POVINI=$PWD/own.ini small lamp.pov -q -o x.exr
  same plain.exr x.exr
  HOME=$PWD/home small lamp.pov -q -o x.exr
  same plain.exr x.exr
}
