#!/usr/bin/env bats
# The scenes of `make gallery`: POV-Ray reads each, their lamps come from the shelf or are baked,
# and their pictures are small.
load house

# stub NAME: an include of the lamp's macros, without its light.
stub() {
  local macro
  macro=$(sed -E 's/(^|_)(.)/\1\u\2/g' <<<"$1")
  cat >"$1.inc" <<POV
#macro ${macro}_Canned(Scale, Gain) sphere { 0, Scale } #end
#macro ${macro}_Canned_Face(Scale, Gain, Eye) sphere { Eye, Scale } #end
#macro ${macro}_Canned_Housing() sphere { 0, 1 } #end
POV
}

@test "POV-Ray reads each scene" {
  cd "$BATS_TEST_TMPDIR"
  local scene lamp log
  for scene in "$ROOT"/lamps/gallery/*.pov; do
    lamp=$(sed -n 's/^#include "\(.*\)\.inc"$/\1/p' "$scene" | grep -v gallery)
    [ -e "$ROOT/lamps/$lamp.pov" ]
    stub "$lamp"
    log=$(povray "+I$scene" "+L$ROOT/lamps/gallery" +W2 +H1 +Q1 -D +Oscene.png 2>&1) ||
      { tail -n 5 <<<"$log" && false; }
    rm scene.png
  done
}

@test "a slab on the shelf is taken, another is baked as its header says" {
  mkdir "$BATS_TEST_TMPDIR/shelf"
  touch "$BATS_TEST_TMPDIR/shelf/desk_lamp.tif"
  run house_make -n gallery "SHELF=$BATS_TEST_TMPDIR/shelf"
  [ "$status" -eq 0 ]
  [[ $output == *"include $BATS_TEST_TMPDIR/shelf/desk_lamp.tif -o "* ]]
  [[ $output != *"bake lamps/desk_lamp.pov"* ]]
  [[ $output == *"bake lamps/candle_tin.pov -o "*"shelf.sh flags lamps/candle_tin.pov"* ]]
}

@test "the pictures are below 1.5 MB" {
  [ "$(cat "$ROOT"/lamps/gallery/*.png | wc -c)" -lt 1500000 ]
  for scene in "$ROOT"/lamps/gallery/*.pov; do [ -s "${scene%.pov}.png" ]; done
}
