#!/usr/bin/env bats
# bakeslab projector: which way round the picture is, colours of kinds of images, refusals.
# Its light is tested in tests/render/test_projector.c.

load slab

setup() {
  needs oiiotool
  cd "$BATS_TEST_TMPDIR" || return
  export TMPDIR=$BATS_TEST_TMPDIR/tmp
  mkdir tmp
  # Red and green above blue and grey.
  printf 'P3\n2 2\n255\n255 0 0  0 255 0\n0 0 255  188 188 188\n' >four.ppm
  where=(--aperture 0.1 --focus 2 --width 1)
}

# declines STATUS PIECE... -- ARGUMENT...: refused, and neither a slab nor anything else is left. The
# variable `program` may name another bakeslab.
declines() {
  local before=()
  while [ "$1" != -- ]; do before+=("$1") && shift; done
  refuses "${before[@]}" -- "${program:-$BAKESLAB}" projector "${@:2}" || return 1
  [ ! -e s.tif ] && [ ! -e s.exr ] && [ -z "$(ls tmp)" ]
}

@test "the picture is upright and not mirrored for who looks along +z" {
  "$BAKESLAB" projector four.ppm -o s.exr "${where[@]}"
  # From the middle of the aperture to the middles of the pixels, 2 away.
  run "$BAKESLAB" lookup s.exr <<<'0 0 0  -0.25 0.25 2
0 0 0  0.25 0.25 2
0 0 0  -0.25 -0.25 2'
  [ "$output" = $'1 0 0\n0 1 0\n0 0 1' ]
  # The same point of the picture from a corner of the aperture.
  [ "$("$BAKESLAB" lookup s.exr <<<'0.04 -0.04 0  -0.29 0.29 2')" = "1 0 0" ]
  # sRGB 188/255 is half the light.
  "$BAKESLAB" lookup s.exr <<<'0 0 0  0.25 -0.25 2' | awk '{ exit !($1 > 0.502 && $1 < 0.504 && $1 == $3) }'
  [ -z "$(ls tmp)" ]
}

@test "the window of an EXR is the picture, and a photo is turned" {
  oiiotool --create 2x2 3 --fill:color=1,0.5,0.25 2x2 --fullsize 4x2+0+0 -d half -o part.exr
  "$BAKESLAB" projector part.exr -o s.exr "${where[@]}"
  [ "$("$BAKESLAB" lookup s.exr <<<$'0 0 0  -0.4 0.1 2\n0 0 0  0.4 0.1 2')" = $'1 0.5 0.25\n0 0 0' ]
  oiiotool four.ppm --orientation 6 -o turned.tif
  "$BAKESLAB" projector turned.tif -o s.exr "${where[@]}"
  [ "$("$BAKESLAB" lookup s.exr <<<$'0 0 0  -0.25 0.25 2\n0 0 0  0.25 0.25 2')" = $'0 0 1\n1 0 0' ]
}

@test "floating-point images are linear, opaque alpha is fine, grey is grey" {
  oiiotool --create 2x2 4 --fill:color=0.5,0.25,2,1 2x2 -d half -o half.exr
  "$BAKESLAB" projector half.exr -o s.exr "${where[@]}"
  [ "$("$BAKESLAB" lookup s.exr <<<'0 0 0  0 0 2')" = "0.5 0.25 2" ]
  oiiotool --create 2x2 2 --chnames Y,A --fill:color=1,1 2x2 -d uint8 -o grey.png
  "$BAKESLAB" projector grey.png -o s.exr "${where[@]}"
  [ "$("$BAKESLAB" lookup s.exr <<<'0 0 0  0 0 2')" = "1 1 1" ]
}

@test "a large image is averaged to 256 samples; the slab tells its name and command" {
  oiiotool --create 1024x512 3 --fill:color=1,1,1 512x512+0+0 -d uint8 -o wide.png
  "$BAKESLAB" projector wide.png -o my_slide.tif "${where[@]}"
  run "$BAKESLAB" info my_slide.tif
  [[ $output == *": my_slide"*"8 x 8 x 256 x 128, logluv"*"cell_means"*"bakeslab projector wide.png -o my_slide.tif"* ]]
  "$BAKESLAB" projector wide.png -o my-slide.exr "${where[@]}" --precision half
  run "$BAKESLAB" info my-slide.exr
  [[ $output == *": projector"*", half"* ]]
  "$BAKESLAB" include my_slide.tif -o my_slide.inc --lights 2
  grep -q My_Slide_Canned my_slide.inc
}

@test "images that are none, or no good" {
  : >empty.png
  printf 'P3\n0 0\n255\n' >nothing.ppm
  printf 'P3\n1000000 1000000\n255\n1 2 3\n' >huge.ppm
  oiiotool --create 2x2 4 --fill:color=1,1,1,0.5 2x2 -d uint8 -o glass.png
  printf 'Pf\n1 1\n-1\n\0\0\300\177' >nan.pfm
  printf 'Pf\n1 1\n-1\n\0\0\200\277' >negative.pfm
  printf 'P4\n65535 65535\n' >large.pbm
  truncate -s 600M large.pbm
  truncate -s 4G zeros.png
  printf '\x89PNG\r\n\x1a\n' >chunks.png
  truncate -s 2G chunks.png
  mkfifo pipe.png
  for name in empty.png nothing.ppm huge.ppm large.pbm zeros.png chunks.png; do
    declines 1 "$name: is no image that can be read" -- "$name" -o s.tif "${where[@]}"
  done
  declines 1 "large.pbm: is no image that can be read: it has more than 2^27 pixels" -- large.pbm -o s.tif "${where[@]}"
  declines 1 "zeros.png: is no image that can be read: it has more than 2 GiB" -- zeros.png -o s.tif "${where[@]}"
  for name in . pipe.png /dev/zero; do
    declines 1 "$name: is not a file" -- "$name" -o s.tif "${where[@]}"
  done
  oiiotool --create 2x2 3 --fill:color=1,1,1 2x2 --attrib PixelAspectRatio 2 -d half -o wide.exr
  declines 1 "wide.exr: says that its pixels are 2 times as wide as high" -- wide.exr -o s.tif "${where[@]}"
  declines 1 "gone.png: No such file" -- gone.png -o s.tif "${where[@]}"
  declines 1 "glass.png: has transparent pixels; put it on black first" -- glass.png -o s.tif "${where[@]}"
  declines 1 "nan.pfm: column 0, row 0 holds a value that is negative or not finite" -- nan.pfm -o s.tif "${where[@]}"
  declines 1 "negative.pfm: column 0, row 0" -- negative.pfm -o s.tif "${where[@]}"
  "$BAKESLAB" projector four.ppm -o slab.tif "${where[@]}"
  "$BAKESLAB" projector four.ppm -o slab.exr "${where[@]}"
  for name in slab.tif slab.exr; do
    declines 1 "$name: is a light slab" -- "$name" -o s.tif "${where[@]}"
  done
  mkdir -p alone/bin
  cp "$BAKESLAB" alone/bin
  program=alone/bin/bakeslab declines 1 "four.ppm: lib/canned/bakeslab-image, which reads images, is not where" -- \
    four.ppm -o s.tif "${where[@]}"
}

@test "outputs that cannot be" {
  declines 1 "s.png: the name must end in .tif, .tiff or .exr" -- four.ppm -o s.png "${where[@]}"
  oiiotool four.ppm -d half -o four.exr
  declines 1 "./four.exr: is read too" -- four.exr -o ./four.exr "${where[@]}"
  declines 1 "samples" -- four.ppm -o s.tif "${where[@]}" --uv 65536 --st 65536
  declines 1 "is not finite" -- four.ppm -o s.exr "${where[@]}" --white 1e39
  declines 1 "use --precision float" -- four.ppm -o s.tif "${where[@]}" --white 1e30
}

@test "arguments that cannot be" {
  declines 2 "no image given" -- -o s.tif "${where[@]}"
  declines 2 "one image at a time" -- four.ppm four.ppm -o s.tif "${where[@]}"
  declines 2 "no output given" -- four.ppm "${where[@]}"
  declines 2 "no opening given: --aperture" -- four.ppm -o s.tif --focus 1 --width 1
  declines 2 "no focus given: --focus" -- four.ppm -o s.tif --aperture 1 --width 1
  declines 2 "--width" -- four.ppm -o s.tif --aperture 1 --focus 1
  for aperture in 0 0x2 2x 1x-1 nan 1,2 x 1e999; do
    declines 2 "--aperture" "must be a positive number" -- four.ppm -o s.tif "${where[@]}" --aperture "$aperture"
  done
  declines 2 "--uv 0x3: must be NxM" -- four.ppm -o s.tif "${where[@]}" --uv 0x3
  declines 2 "--white and --flux" -- four.ppm -o s.tif "${where[@]}" --white 1 --flux 1
  declines 2 "radiance_unit is \"lux\"" -- four.ppm -o s.tif "${where[@]}" --unit lux
  declines 2 "st_window" -- four.ppm -o s.tif --aperture 1 --focus 1e-200 --width 1e200
  declines 2 "area 0" -- four.ppm -o s.tif --aperture 1e-200 --focus 1 --width 1
}

@test "one pixel is a light of one colour; children that nobody waits for are no trouble" {
  printf 'P3\n1 1\n255\n255 255 255\n' >one.ppm
  (trap '' CHLD && "$BAKESLAB" projector one.ppm -o s.exr "${where[@]}")
  [ "$("$BAKESLAB" lookup s.exr <<<'0 0 0  0.49 -0.49 2')" = "1 1 1" ]
}
