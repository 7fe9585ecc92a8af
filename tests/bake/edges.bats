#!/usr/bin/env bats
# A bake in odd surroundings: awkward names, a full disk, streams that are closed,
# scripts with unusual text.
load bake

setup() { bake_setup; }
teardown() { ! mountpoint -q disk || umount disk; }

# value FILE: the radiance along the axis.
value() { echo 0 0 0 0 0 1 | "$BAKESLAB" lookup "$1"; }

@test "spaces, =, quotes and letters beyond ASCII in every name" {
  local folder="a b='c\"d& größe"
  mkdir -p "$folder/ Zoë=1"
  flat_lamp "$folder/my lamp=ö'\".pov" '#include "my parts=1.inc"'
  echo 'sphere { <0, 0, -0.9>, 0.01 pigment { rgb 1 } finish { emission 40 diffuse 0 } }' >"$folder/my parts=1.inc"
  small "$folder/my lamp=ö'\".pov" -q -o "$folder/ Zoë=1/o u't\"=.exr"
  # The sphere of the include is seen.
  "$BAKESLAB" info "$folder/ Zoë=1/o u't\"=.exr" | grep -q flat
  [ "$(find . -name '*.partial')" = "" ]
  echo 'box { ouch }' >"$folder/my parts=1.inc"
  refused 1 "größe/my parts=1.inc' line 1: .*ouch" x.tif bake "$folder/my lamp=ö'\".pov" -o x.tif
}

@test "files beside the script may have any name, and -L finds others" {
  mkdir lib
  echo '#declare Bright = 2;' >"lib/bright ness.inc"
  sed 's/emission 0.5/emission Bright/' flat.pov >lamp.pov
  (echo '#include "bright ness.inc"' && cat lamp.pov) >bright.pov
  small bright.pov -q -o x.exr -L lib
  [ "$(value x.exr)" = "2 2 2" ]
  # A variant of a lamp of that very name.
  cp flat.pov lamp.pov
  echo '#include "lamp.pov"' >variant.pov
  small variant.pov -q -o y.exr
  [ "$(value y.exr)" = "0.5 0.5 0.5" ]
}

@test "run from another folder, by an absolute and by a linked name" {
  mkdir -p there other
  echo '#declare Bright = 2;' >there/bright.inc
  (echo '#include "bright.inc"' && sed 's/emission 0.5/emission Bright/' flat.pov) >there/lamp.pov
  ln -s ../there/lamp.pov other/link.pov
  small "$PWD/there/lamp.pov" -q -o other/x.exr
  [ "$(value other/x.exr)" = "2 2 2" ]
  (cd other && small link.pov -q -o y.exr)
  [ "$(value other/y.exr)" = "2 2 2" ]
}

@test "a program in a folder with a space" {
  local built
  built=$(dirname "$(dirname "$BAKESLAB")")
  mkdir 'my tools'
  cp -rL "$built/bin" "$built/lib" "$built/share" 'my tools/'
  "my tools/bin/bakeslab" bake flat.pov -q -o x.exr --uv 2 --st 4 --rays 4
  [ "$(value x.exr)" = "0.5 0.5 0.5" ]
}

@test "a POV-Ray named by a relative path" {
  ln -s "$(command -v povray)" mine
  small flat.pov -q -o x.exr --povray ./mine
}

@test "streams that are closed, signals that are ignored, no environment" {
  (small flat.pov -o a.exr 2>&-)
  (small flat.pov -o b.exr <&- >&- 2>&-)
  (trap '' CHLD PIPE HUP && small flat.pov -o c.exr 2>/dev/null)
  small flat.pov -o d.exr 2> >(:) || [ "$?" -eq 141 ] # SIGPIPE, with the slab written
  (env -i PATH="$PATH" "$BAKESLAB" bake flat.pov -q -o e.exr --uv 2 --st 4 --rays 4)
  local n
  for n in a b c d e; do [ "$(value "$n.exr")" = "0.5 0.5 0.5" ]; done
}

@test "an ended probe: a script without end" {
  (sed 's/Canned_Lamp/#while (1) #end\n&/' flat.pov) >endless.pov
  run -124 timeout -s INT -k 10 1 "$BAKESLAB" bake endless.pov -o x.tif
  echo "$output"
  [[ $output == "bakeslab: interrupted"* ]]
  [ ! -e x.tif.partial ]
}

@test "a script with words, files and settings of its own" {
  flat_lamp lamp.pov '#debug "Rendered 5 of 5 pixels: Error: none, Fatal error: none\n"
#warning "Parse Error: not at all\n"
#fopen Notes "notes.txt" write
#write (Notes, "1, 2,\n")
#fclose Notes
#fopen Notes "notes.txt" read
#read (Notes, One, Two)
#fclose Notes
#if (Two != 2) #error "not read\n" #end
global_settings { assumed_gamma 2.2 max_trace_level 7 ambient_light 1 }
background { rgb 1 }
camera { orthographic location -z look_at 0 }
camera { location y look_at x }'
  small lamp.pov -q -o x.exr
  [ "$(value x.exr)" = "0.5 0.5 0.5" ]
  [ ! -e notes.txt ]
  small flat.pov -q -o y.exr
  same x.exr y.exr
}

@test "the clock stands still for every camera" {
  sed 's/emission 0.5/emission 0.5 + clock/' flat.pov >lamp.pov
  local camera
  for camera in mesh perspective transposed; do
    bake lamp.pov -q -o "$camera.exr" --uv 2x1 --st 2x1 --rays 2 --camera "$camera"
    [ "$(value "$camera.exr")" = "0.5 0.5 0.5" ]
  done
}

@test "caustics: glass before a bulb brightens what is behind it" {
  cat >lamp.pov <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("lens")
Canned_Needs("caustics")
Canned_Slab(<6.5, 0, 0>, <0.2, 0, 0>, <0, 0.2, 0>, <0, 0, 1>, <0.48, 0.52, -0.02, 0.02>, 0)
Canned_Bulb(<0, 0, -4>, 0.3, 1000)
sphere { <0, 0, -8>, 2 pigment { rgbf 1 } interior { ior 1.5 } photons { target refraction on reflection off } }
plane { z, -13 pigment { rgb 0.8 } finish { diffuse 1 } }
LAMP
  bake lamp.pov -q -o with.exr --uv 2 --st 2 --rays 16 --uniform
  bake lamp.pov -q -o without.exr --uv 2 --st 2 --rays 16 --uniform --effects none
  flux() { "$BAKESLAB" info "$1" | awk '$1 == "flux" { print $2 }'; }
  echo "$(flux with.exr) $(flux without.exr)"
  # The slab looks past sphere and bulb at the wall's middle, where the sphere gathers light.
  awk "BEGIN { exit !($(flux with.exr) > 1.2*$(flux without.exr)) }"
}

@test "a disk that fills: said so, and after making room the bake goes on" {
  mkdir disk
  mount -t tmpfs -o size=5m none disk 2>/dev/null || skip 'needs the right to mount'
  slow_lamp
  slow -q -o whole.tif
  run -1 slow -o disk/x.tif --jobs 1
  echo "$output"
  [[ $output == "bakeslab: disk/x.tif.partial: the disk is full; make room and run the same command again"* ]]
  [ ! -e disk/x.tif ]
  [ -z "$(find disk -name 'scratch.*')" ]
  mount -o remount,size=40m disk
  run -0 slow -o disk/x.tif
  echo "$output"
  [[ $output =~ \ [1-9]\ of\ them\ found ]]
  same disk/x.tif whole.tif
  # So full that nothing fits at all.
  rm disk/x.tif
  dd if=/dev/zero of=disk/ballast bs=1M count=100 2>/dev/null || true
  run -1 slow -o disk/x.tif
  echo "$output"
  [[ $output == "bakeslab: "*"No space left on device"* || $output == *"the disk is full"* ]]
  [ ! -e disk/x.tif ]
  [ ! -e disk/x.tif.partial ]
}
