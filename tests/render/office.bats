#!/usr/bin/env bats
# The office of figure 6: the mesh that it writes is the scene that POV-Ray draws, and its
# light and camera stand where the scene's do.

setup() {
  load render
  needs oiiotool
  cd "$BATS_TEST_TMPDIR" || return
}

@test "POV-Ray's picture of the office and renderslab's of its mesh agree" {
  letter_slab parabolic_small.tif parabolic_small 4 3 '"center": [0, 0, 0], "u": [14, 0, 0], "v": [0, 0, 12], "normal": [0, -1, 0], "st_window": [-1, 1, -1.2, 0.9], "st_distance": 60'
  "$BAKESLAB" include parabolic_small.tif -o parabolic_small.inc
  office() { povray "+I$CANNED_INCLUDE/office.pov" "+L$CANNED_INCLUDE" -A -D +FE "$@" >povray.log 2>&1; }
  office +W1 +H1 +Omesh.exr Declare=Write_Mesh=1
  office +W96 +H72 +Ooffice.exr
  "$RENDERSLAB" image office.obj --light "parabolic_small.tif $(cat office.light)" --camera "$(cat office.camera)" \
    --size 96x72 --method views -q -o mesh.exr
  error=$(relative mesh.exr office.exr)
  echo "# $error %"
  below "$error" 3
}
