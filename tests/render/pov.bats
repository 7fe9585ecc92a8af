#!/usr/bin/env bats
# renderslab pov: POV-Ray renders the same picture from it, lit by the includes of the same
# slabs. Both sum over the slab's uv samples, so what remains is POV-Ray's half floats (2e-4)
# and edges of shadows.
load letter

@test "a floor" {
  REFERENCE=5 agree 0.1 floor floor.obj --light 'letter_f.tif at=0,1,0'
}

@test "a floor in the shadow of a board and a ball" {
  REFERENCE=10 agree 2 occluder occluder.obj --light 'letter_f.tif at=0,1,0'
}

@test "a lamp turned, scaled, brighter and coloured" {
  agree 0.1 turned floor.obj --light 'letter_f.tif at=-0.5,1.2,-0.3 toward=0.2,0,0.4 up=1,0.3,0.5 scale=1.7 gain=3,0.5,1.2'
}

@test "a mirrored lamp, by its matrix" {
  agree 0.1 mirrored floor.obj --light 'letter_f.tif matrix=-2,0,0,0,1.6,1.2,0,-1.2,1.6,0.3,2,0.4'
  # No other than itself.
  "$RENDERSLAB" image floor.obj --light 'letter_f.tif matrix=2,0,0,0,1.6,1.2,0,-1.2,1.6,0.3,2,0.4' --method views \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 160x120 -q -o other.exr
  below 10 "$(relative other.exr mirrored.exr)"
}

@test "two lamps of one slab, over a board and a ball" {
  agree 2 two occluder.obj --light 'letter_f.tif at=-0.5,1.2,-0.3 toward=0.2,0,0.4 up=1,0.3,0.5 scale=1.7 gain=0.7' \
    --light 'letter_f.tif at=0.5,1.5,0.2 toward=0,0,0.4'
  [ "$(grep -c '^#include' two.pov)" -eq 1 ]
  [ "$(grep -c '^object { Letter_F_Canned' two.pov)" -eq 2 ]
}

@test "highlights, on a floor and on interpolated normals" {
  REFERENCE=10 agree 2 gloss gloss.obj --light 'letter_f.tif at=0,1,0'
  "$RENDERSLAB" image gloss.obj --light 'letter_f.tif at=0,1,0' --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 160x120 -q -o view.exr
  sed 's/^Ks.*/Ks 0 0 0/' -i gloss.mtl
  "$RENDERSLAB" image gloss.obj --light 'letter_f.tif at=0,1,0' --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 160x120 -q -o matt.exr
  below 5 "$(relative matt.exr view.exr)"
}

@test "emission, background and a texture the right way up" {
  oiiotool --create 64x64 3 --fill:color=0.9,0.2,0.1 64x64+0+0 --fill:color=0.1,0.4,0.9 32x64+0+0 \
    --fill:color=1,1,0 20x20+0+0 --fill:color=0,0,0 8x20+50+40 -o texture.png
  agree 0.5 patches patches.obj --light 'letter_f.tif at=-0.5,1,-0.5' --background 0.001,0.002,0.003
  "$RENDERSLAB" image patches.obj --light 'letter_f.tif at=-0.5,1,-0.5' --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 160x120 -q -o view.exr
  sed '/^map_Kd/d' -i patches.mtl
  "$RENDERSLAB" image patches.obj --light 'letter_f.tif at=-0.5,1,-0.5' --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 160x120 -q -o plain.exr
  below 2 "$(relative plain.exr view.exr)"
}

@test "another folder, a name of its own, and what POV-Ray cannot do" {
  mkdir 'a "lamp"'
  cp letter_f.tif 'a "lamp"/l.1.tif'
  "$BAKESLAB" include 'a "lamp"/l.1.tif' -o 'a "lamp"/l.1.inc' --name other_lamp
  sed 's/^Ks.*/Ks 0.9 0.1 0.2/' -i gloss.mtl
  run --separate-stderr "$RENDERSLAB" pov gloss.obj --light '"a \"lamp\"/l.1.tif" at=0,1,0' \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1' --size 8x6 -o quoted.pov
  if [ "$status" -ne 0 ]; then # no quotes in a LIGHT
    mv 'a "lamp"' lamp
    run --separate-stderr "$RENDERSLAB" pov gloss.obj --light 'lamp/l.1.tif at=0,1,0' \
      --camera 'from=0.3,2,-2.2 at=0,0,0.1' --size 8x6 -o quoted.pov
  fi
  [ "$status" -eq 0 ]
  # shellcheck disable=SC2154 # set by run
  [[ $stderr == *"note: material floor: POV-Ray's highlights have one amount"* ]]
  # shellcheck disable=SC2154
  [ "${#stderr_lines[@]}" -eq 1 ]
  grep -q 'Other_Lamp_Canned(1, 1)' quoted.pov
  povray_renders quoted.pov quoted.exr 8 6
}

@test "refused: no include, an alien one, two of one name, the slab as its image" {
  camera='from=0,2,-3 at=0,0,0'
  cp letter_f.tif bare.tif
  cp letter_f.tif alien.tif
  echo '#declare X = 1;' >alien.inc
  cp letter_f.tif twin.tif
  "$BAKESLAB" include twin.tif -o twin.inc
  "$BAKESLAB" convert letter_f.tif -o own.exr
  before=$(ls)
  pov=("$RENDERSLAB" pov floor.obj --camera "$camera")
  refuses "[12]" 'bare.inc' 'bakeslab include bare.tif -o bare.inc' -- "${pov[@]}" --light bare.tif -o a.pov
  refuses "[12]" alien.inc 'bakeslab include alien.tif -o alien.inc' -- "${pov[@]}" --light alien.tif -o a.pov
  refuses "[12]" twin.inc letter_f.inc Letter_F --name -- "${pov[@]}" --light letter_f.tif --light twin.tif -o a.pov
  refuses "[12]" own.exr 'bakeslab convert own.exr' -- "${pov[@]}" --light own.exr -o a.pov
  refuses "[12]" nowhere -- "${pov[@]}" --light letter_f.tif -o nowhere/a.pov
  refuses "[12]" letter_f.inc -- "${pov[@]}" --light letter_f.tif -o letter_f.inc
  refuses "[12]" floor.obj -- "${pov[@]}" --light letter_f.tif -o floor.obj
  refuses "[12]" output -- "${pov[@]}" --light letter_f.tif
  [ "$(ls)" = "$before" ]
  run -0 --separate-stderr "${pov[@]}" --light letter_f.tif -o -
  [[ $output == *'mesh2 {'* ]]
}

# Before black: POV-Ray shows what is behind a lamp, too.
@test "a camera that looks into lamps: turned, mirrored, scaled, coloured; and from behind" {
  local lamps=(--light 'letter_f.tif at=0.4,1.2,-0.3 toward=0.1,0,-1 up=1,0.3,0.5 scale=1.7 gain=3,0.5,1.2'
    --light 'letter_f.tif matrix=-2,0,0,0,1.6,1.2,0,-1.2,1.6,-0.5,1.2,0.2' --light 'letter_f.tif at=0.35,0.42,-1')
  CAMERA='from=0.1,0.25,-1.32 at=0.1,0.8,0.1 fov=110' agree 0.1 faces floor.obj "${lamps[@]}"
  [ "$(grep -c 'Canned_Face' faces.pov)" -eq 3 ]
  "$RENDERSLAB" pov floor.obj --light 'letter_f.tif at=0,1,0' --camera 'from=0,5,-1 at=0,0,0' -o behind.pov
  run -1 grep 'Canned_Face' behind.pov
}
