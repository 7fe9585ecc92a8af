#!/usr/bin/env bats
# bakeslab import with pictures: an array of views is a bake's own samples, posed pictures light a
# floor as the lamp does; exposure; refusals.

load ../testing
load poses.bash

setup() {
  needs povray oiiotool jq
  cd "$BATS_TEST_TMPDIR" || return
  lamps=${CANNED_INCLUDE%/*}/tests/bake/lamps
  where=(--center "0,0,0" --u "4,0,0" --v "0,0,2" --normal "0,-1,0")
  window=(--window "-1,0.5,-0.75,1")
}

# A lamp whose radiance varies along all four axes.
waves() {
  cat >waves.pov <<'POV'
#version 3.7;
#include "canned.inc"
#include "known.inc"
Canned_Lamp("waves")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <4, 0, 0>, <0, 0, 2>, <0, -1, 0>, <-1, 0.5, -0.75, 1>, 0)
Waves(<0, 0, 0>, <4, 0, 0>, <0, 0, 2>, <0, -1, 0>, 3)
POV
}

# frames SCENE WIDTH HEIGHT COUNT NAME: an animation by POV-Ray.
frames() {
  povray "$1" "+L$lamps" "+L$CANNED_INCLUDE" +FE -A -D "+W$2" "+H$3" +KFI1 "+KFF$4" +KI1 "+KF$4" \
    "+O$5.exr" >frames.log 2>&1
}

import() { "$BAKESLAB" import -q "$@"; }

# declines STATUS PIECE... -- ARGUMENT...: refused, and no slab is left.
declines() {
  local before=()
  while [ "$1" != -- ]; do before+=("$1") && shift; done
  refuses "${before[@]}" -- "$BAKESLAB" import "${@:2}" && [ ! -e s.exr ]
}

# grey NAME VALUE [SIZE] [DEPTH]
grey() { oiiotool --create "${3-4x4}" 3 --fill:color="$2,$2,$2" "${3-4x4}" -d "${4-float}" -o "$1"; }

# posed PICTURE...: transforms.json with all of them in front of the aperture, 10 below it and
# looking up, side by side. In the file's frame, z is up.
posed() {
  printf '%s\n' "$@" | jq -R . | jq -s '{camera_angle_x: 0.7, frames: [to_entries[] | {file_path: .value,
    transform_matrix: [[1,0,0,.key],[0,-1,0,0],[0,0,-1,-10],[0,0,0,1]]}]}' >transforms.json
}

@test "an array of views has the bits of a bake by perspective cameras" {
  waves
  cat >views.pov <<'POV'
#version 3.7;
#include "waves.pov"
#local I = mod(frame_number - 1, 2);
#local J = int((frame_number - 1)/2);
camera {
  perspective location <2*I - 1, 0, J - 0.5>
  direction <0.25, 1, -0.125>  // against the light along the middle of the window
  right -1.5*x up 1.75*z
}
POV
  frames views.pov 12 7 4 v
  local n
  for n in 1 2 3 4; do
    mv "v$n.exr" "view_$(printf '%02d_%02d' $(((n - 1) % 2)) $(((n - 1) / 2))).exr"
  done
  "$BAKESLAB" bake waves.pov -o baked.exr -L "$lamps" -q --uv 2x2 --st 12x7 --centre --gain 1 \
    --camera perspective --window declared
  import --views 'view_%02u_%02v.exr' -o s.exr "${where[@]}" "${window[@]}"
  "$BAKESLAB" diff --tolerance 0 s.exr baked.exr
  "$BAKESLAB" info --json s.exr | jq -e '.pages[0].provenance.import.kind == "views"
    and .pages[0].samples_are == "points"'
  # twice the light, by half as many directions
  import --views 'view_%02u_%02v.exr' -o half.exr "${where[@]}" "${window[@]}" --exposure 2 --st 6x7
  "$BAKESLAB" convert baked.exr --st 6x7 -o want.exr
  run "$BAKESLAB" diff half.exr want.exr
  awk '$3 == "flux" { exit !($4/$8 > 1.9999 && $4/$8 < 2.0001) }' <<<"$output"
}

@test "pictures with poses light a floor as the lamp does, and say what is filled in" {
  waves
  printf '#version 3.7;\n#include "waves.pov"\n#include "cameras.inc"\n' >pictures.pov
  poses 16 12 5 32
  frames pictures.pov 32 32 16 picture
  run --separate-stderr "$BAKESLAB" import transforms.json -o s.exr "${where[@]}" "${window[@]}" --uv 8x4
  [ "$status" -eq 0 ]
  # shellcheck disable=SC2154 # run sets it
  [[ $stderr == *"no picture shows "*" % of the samples, with "*" % of the flux"* ]]
  [[ $stderr == *"comes from beside the pages"* ]]
  "$BAKESLAB" bake waves.pov -o baked.exr -L "$lamps" -q --uv 8x4 --st 8x8 --rays 4 --window declared
  awk 'BEGIN { for (n = 0; n < 49; ++n) print (n%7 - 3.5), -6, (int(n/7) - 3), "0 1 0" }' >floor
  # directions finer than the cameras stand are interpolated, not left to be filled in
  import transforms.json -o finer.exr "${where[@]}" "${window[@]}" --uv 8x4 --st 16x16
  "$RENDERSLAB" irradiance --light baked.exr <floor >want
  for slab in finer s; do
    "$RENDERSLAB" irradiance --light $slab.exr <floor >got
    paste got want | awk '{ off += ($2 - $5)^2; all += $5^2 } END { print sqrt(off/all); exit !(sqrt(off/all) < 0.06) }'
  done
  "$BAKESLAB" info --json s.exr | jq -e '.pages[0].provenance.import
    | .kind == "posed pictures" and .error > 0 and .error < 0.2 and (.assumptions | test("filled in"))'
}

@test "exposure; the window and the directions follow from the cameras; a name without ending" {
  for n in 1 2 3; do grey $n.exr 2 8x8; done
  posed 1 ./2.exr "$PWD/3.exr"
  run --separate-stderr "$BAKESLAB" import transforms.json -o s.exr --center 0,0,0 --u 2,0,0 --v 0,0,2 \
    --normal 0,-1,0
  # in one line: there is no window along t
  [ "$status" -eq 1 ] && [[ $stderr == *"give --window"* ]]
  import transforms.json -o s.exr --center 0,0,0 --u 2,0,0 --v 0,0,2 --normal 0,-1,0 \
    --window "-0.5,0.5,-0.5,0.5" --exposure 1.5
  "$BAKESLAB" lookup s.exr <<<'0.1 0 0.2  0.02 -1 0.1' |
    awk '{ print; exit !($1 == $2 && $2 == $3 && $1 > 2.99999 && $1 < 3.00001) }'
}

@test "pictures that are no good" {
  grey a.exr 1
  grey wide.exr 1 6x4
  grey photo.png 0.5 4x4 uint8
  grey sixteen.tif 0.5 4x4 uint16
  posed a.exr wide.exr
  declines 1 "transforms.json: frame 2: wide.exr: is 6 x 4 pixels, not 4 x 4" -- transforms.json -o s.exr "${where[@]}" "${window[@]}"
  posed a.exr gone.exr
  declines 1 "transforms.json: frame 2: gone.exr: No such file" -- transforms.json -o s.exr "${where[@]}" "${window[@]}"
  for name in photo.png sixteen.tif; do
    posed $name
    declines 1 "transforms.json: frame 1: $name: is not linear" -- transforms.json -o s.exr "${where[@]}" "${window[@]}"
  done
  for name in u0v0 u1v0 u0v1 u1v1; do grey $name.exr 1; done
  grey u1v1.exr 1 5x4
  declines 1 "u1v1.exr: is 5 x 4 pixels, not 4 x 4" -- --views u%uv%v.exr -o s.exr "${where[@]}" "${window[@]}"
  rm u1v1.exr
  declines 1 "u1v1.exr: No such file" -- --views u%uv%v.exr -o s.exr "${where[@]}" "${window[@]}"
  declines 1 "x%uv%v.exr: no file in . has such a name" -- --views x%uv%v.exr -o s.exr "${where[@]}" "${window[@]}"
}

@test "files of poses that are no good" {
  grey a.exr 1
  posed a.exr
  jq '.frames = []' transforms.json >none.json
  declines 1 "none.json: there are no frames" -- none.json -o s.exr "${where[@]}" "${window[@]}"
  head -c 100 transforms.json >cut.json
  declines 1 "cut.json: malformed JSON: line" -- cut.json -o s.exr "${where[@]}" "${window[@]}"
  jq '.k1 = 0.1' transforms.json >lens.json
  declines 1 "lens.json: frame 1: k1 is 0.1: lens distortion" -- lens.json -o s.exr "${where[@]}" "${window[@]}"
  jq '.frames[0].transform_matrix[0] = [0,0,0,0]' transforms.json >flat.json
  declines 1 "flat.json: frame 1: transform_matrix is singular" -- flat.json -o s.exr "${where[@]}" "${window[@]}"
  jq '.w = 9 | .h = 4' transforms.json >size.json
  declines 1 "a.exr: is 4 x 4 pixels, not 9 x 4 as its pose says" -- size.json -o s.exr "${where[@]}" "${window[@]}"
  # a page that no picture shows, or that looks away
  declines 1 "page 1: no picture shows it" -- transforms.json -o s.exr --center 90,0,0 --u 1,0,0 --v 0,0,1 \
    --normal 0,-1,0 "${window[@]}"
  declines 1 "page 1: no camera stands before it" -- transforms.json -o s.exr --center 0,0,0 --u 1,0,0 \
    --v 0,0,1 --normal 0,1,0
}

@test "arguments that cannot be" {
  grey a.exr 1
  posed a.exr
  declines 1 "give --center, --u, --v and --normal" -- transforms.json -o s.exr
  declines 1 "transforms.json: --lumens and --tolerance are not for pictures" -- transforms.json -o s.exr "${where[@]}" --lumens 5
  declines 1 "give one file of poses at a time" -- transforms.json transforms.json -o s.exr "${where[@]}"
  declines 1 "and --window" -- --views u%uv%v.exr -o s.exr "${where[@]}"
  declines 1 "one %u and one %v" -- --views u%u.exr -o s.exr "${where[@]}" "${window[@]}"
  declines 1 "no other %" -- --views u%uv%v%d.exr -o s.exr "${where[@]}" "${window[@]}"
  declines 1 "--vignetting is for pictures with poses" -- --views u%uv%v.exr -o s.exr "${where[@]}" "${window[@]}" \
    --vignetting 1,0,0
  declines 2 "--views and a file" -- transforms.json --views u%uv%v.exr -o s.exr
  declines 2 "--window 1,2,3: must be four slopes" -- transforms.json -o s.exr --window 1,2,3
  declines 2 "--window 1,-1,0,1: must be four slopes" -- transforms.json -o s.exr --window 1,-1,0,1
  declines 2 "--vignetting 1: must be three numbers" -- transforms.json -o s.exr --vignetting 1
  declines 2 "no file given" -- -o s.exr
  declines 1 "a.exr: column 0, row 0: --vignetting makes its factor" -- transforms.json -o s.exr "${where[@]}" \
    "${window[@]}" --vignetting=-2,0,0
}
