#!/usr/bin/env bats
# What is preloaded into POV-Ray so that its front end looks for news more often: a picture is the
# same with it. tests/unit/test_polls.c: which sleeps and waits it shortens.
load bake

setup() {
  needs povray
  bake_setup
  cat >scene.pov <<'SCENE'
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0, 1, -4> look_at 0 }
light_source { <3, 5, -4> rgb 1 area_light x, y, 3, 3 }
sphere { 0, 1 pigment { bozo color_map { [0 rgb 1] [1 rgb <1, 0.3, 0>] } } finish { reflection 0.3 } }
plane { y, -1 pigment { checker rgb 1 rgb 0.2 } }
SCENE
}

# picture NAME: its samples in NAME.raw; its file says when it was rendered.
picture() {
  povray +Iscene.pov "+O$1.ppm" +FP8 +W64 +H48 +A0.1 +WT2 -D >"$1.log" 2>&1
  tail -c $((3 * 64 * 48)) "$1.ppm" >"$1.raw"
}

@test "POV-Ray renders the same picture with it" {
  picture usual
  LD_PRELOAD=$(dirname "$BAKESLAB")/../lib/canned/reads.so picture quick
  run -1 grep -i preload quick.log
  [ "$(tr -d '\0' <usual.raw | wc -c)" -gt 5000 ]
  cmp usual.raw quick.raw
}
