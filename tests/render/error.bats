#!/usr/bin/env bats
# renderslab image --stats: how a picture's error is told (test_image_error.c: whether it is right).
# shellcheck disable=SC2154 # run sets stderr
load letter

picture() { # OUT.exr OPTION...
  local out=$1
  shift
  "$RENDERSLAB" image occluder.obj --size 40x30 --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' \
    -o "$out" "$@"
}

# attribute FILE: that of the picture's error.
attribute() { oiiotool --info -v "$1" | sed -n 's/^ *error: "\(.*\)"$/\1/p' | head -1; }

@test "the statistics, the picture's file and a note tell one error" {
  run -0 --separate-stderr picture a.exr --light 'letter_f.tif at=0,1,0' --stats a.json
  [ "$stderr" = "renderslab: a.exr: note: error $(attribute a.exr)" ]
  [[ $stderr =~ error\ noise\ unknown,\ resolution\ [0-9.e+]+\ %,\ LogLuv\ 0\ %,\ sum\ [0-9.e-]+\ %,\ shadows\ [0-9.e-]+\ %\;\ all\ at\ least\ [0-9.e+]+\ %\ \(RMS\ over\ mean\)$ ]]
  jq -e '.error | .noise == null and .logluv == 0 and .resolution > 0 and .sum < 1e-3
    and .shadows > 0 and .shadows < 0.1
    and (.all - ([.resolution, .sum, .shadows] | map(. * .) | add | sqrt) | fabs) < 1e-4' a.json
  jq -e '.seconds.error >= 0' a.json
}

@test "no error is estimated where nobody asked" {
  picture a.exr --light 'letter_f.tif at=0,1,0'
  [ -z "$(attribute a.exr)" ]
}

@test "rounding to LogLuv is told where the slab's file has it" {
  "$BAKESLAB" convert letter_f.tif -o logluv.tif --precision logluv
  picture a.exr --light 'logluv.tif at=0,1,0' --stats a.json -q
  picture b.exr --light 'letter_f.tif at=0,1,0' -q
  # A step's RMS of each number, where a picture has one colour: what it truly is, is chance.
  jq -e --argjson off "$(relative a.exr b.exr)" '.error.logluv * 100 / $off | . > 0.5 and . < 10' a.json
}

@test "a scene that the lamps do not light is told in words, not in numbers" {
  for light in 'letter_f.tif at=0,1,0 toward=0,2,0' 'letter_f.tif at=0,1,0 gain=0'; do
    run -0 --separate-stderr picture dark.exr --light "$light" --stats dark.json
    [ "$stderr" = "renderslab: dark.exr: note: error unknown: the lamps light nothing that the picture shows" ]
    [ "$(attribute dark.exr)" = "unknown: the lamps light nothing that the picture shows" ]
    jq -e '[.error[] | . == null] | length == 6 and all' dark.json
  done
}

@test "a method's error is told by what it misses" {
  picture a.exr --light 'letter_f.tif at=0,1,0' --method views --stats views.json -q
  picture a.exr --light 'letter_f.tif at=0,1,0' --method reference --stats reference.json -q
  jq -e '.error.sum > 0.01 and .error.sum < 1' views.json
  jq -e '.error.sum < 1e-4' reference.json
}

@test "pixels that share rays err; the picture is written in time, without its error" {
  picture a.exr --light 'letter_f.tif at=0,1,0' --size 640x480 --time-limit 0.02 --stats a.json -q
  [ -z "$(attribute a.exr)" ]
  jq -e '.error.sum > 0.01' a.json
}

@test "the same for any number of threads" {
  for threads in 1 3; do
    picture a.exr --light 'letter_f.tif at=0,1,0' --threads $threads --stats - -q | jq .error >$threads.json
  done
  cmp 1.json 3.json
}
