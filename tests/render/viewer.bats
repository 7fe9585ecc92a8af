#!/usr/bin/env bats
# renderslab view in a window: keys, pictures that are saved and made again, refusals.
load render

setup_file() {
  needs oiiotool xvfb-run xdotool
  cd "$BATS_FILE_TMPDIR" || return
  cp "$BATS_TEST_DIRNAME"/scenes/{gloss,patches}.{obj,mtl} .
  oiiotool --pattern checker:width=4:height=4:color1=0.9,0.8,0.1:color2=0.1,0.3,0.9 16x16 3 -d uint8 -o texture.png
  letter_slab letter_f.tif letter_f 4 3 '"center": [0, 0, 0], "u": [0.2, 0, 0], "v": [0, 0, 0.16], "normal": [0, -1, 0], "st_window": [-1, 1, -1.2, 0.9], "st_distance": 0.8, "channel": "warm"'
}

setup() {
  mkdir "$BATS_TEST_TMPDIR/run"
  cd "$BATS_TEST_TMPDIR/run" || return
  ln -s "$BATS_FILE_TMPDIR"/* .
  if [ "${CONFIG-}" = sanitize ]; then export LD_PRELOAD=$BUILD/tests/faults/keep.so; fi
}

# display COMMAND...: on a display of its own. A server that resets itself when its last window
# closes signals xvfb-run again, which then at times fails to clean up.
display() { xvfb-run -a -s '-screen 0 800x600x24 -noreset' "$@"; }

# view MESH OPTION...: in a window.
view() {
  display "$RENDERSLAB" view "$1" --size 200x150 -q "${@:2}"
}

# made_again COMMAND: it makes the picture that was saved, to 0.1 % (relative RMS), but for at
# most 20 pixels, 0.07 % of them, that are off by more than a tenth of the mean: edges of surfaces
# are rounded to 1/256 pixel when they are drawn.
made_again() {
  local saved=${1##* } rgb=(--ch 'R,G,B') mean most count error
  eval "\"\$RENDERSLAB\" ${1#renderslab } -q -o again.exr"
  mean=$(mean_of again.exr | tr , '\n' | awk '{ s += $1 } END { print s/3 }')
  most=$(awk -v m="$mean" 'BEGIN { print m/10 }')
  oiiotool "$saved" "${rgb[@]}" again.exr "${rgb[@]}" --absdiff -o off.exr
  count=$(oiiotool off.exr --maxchan --rangecheck 0 "$most" -o none.exr | awk '/> / { print $1 }')
  oiiotool off.exr "--clamp:max=$most,$most,$most" -o off.exr
  error=$(paste -d, <(mean_of off.exr --dup --mul) <(mean_of again.exr "${rgb[@]}" --dup --mul) |
    awk -F, '{ print 100*sqrt(($1 + $2 + $3)/($4 + $5 + $6)) }')
  echo "# $saved: $error % off, $count pixels elsewhere; mean $mean"
  below 1e-6 "$mean" && below "$error" 0.1 && [ "$count" -le 20 ]
}

@test "keys turn, move, dim and save; the command that is printed makes the picture again" {
  run -0 --separate-stderr view gloss.obj --light 'letter_f.tif at=0.3,1.2,0.1 toward=0.2,0,0.3 gain=3' \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --keys 's left left up 1 right shift+up shift+right [ [ [ ] s q'
  [ "${#lines[@]}" -eq 2 ]
  # shellcheck disable=SC2154 # set by run
  [ -z "$stderr" ]
  [[ ${lines[0]} == *"at=0.3,1.2,0.1 toward=0.2,0,0.3 gain=3"* && ${lines[1]} == *"letter_f.tif matrix="*" gain.warm=0.8"* ]]
  made_again "${lines[0]}"
  made_again "${lines[1]}"
  [[ $(oiiotool --info -v view-2.exr) == *"matrix="* ]]
  below 10 "$(relative view-1.exr view-2.exr)"
}

@test "fewer views, shadows, groups, a background, textures, two lights and no camera" {
  run -0 --separate-stderr view patches.obj --background 0.01,0.03,0.02 --light 'letter_f.tif at=0,1.5,0' \
    --light 'letter_f.tif at=1,1,-2 toward=0,0,0 gain=9' --keys 'd v s d G s q'
  [[ ${lines[0]} == *'--level 1 --no-shadows'*'--background=0.01'* ]]
  [[ ${lines[1]} == *'--level 1 --shadow-map 1024 --shadow-groups 8'* ]]
  made_again "${lines[0]}"
  made_again "${lines[1]}"
}

@test "a lamp that the camera looks into" {
  run -0 --separate-stderr view gloss.obj --light 'letter_f.tif at=0,0.8,0 toward=0,0.8,-1 scale=3' \
    --camera 'from=0.1,1,-2 at=0,0.7,0' --keys 's q'
  made_again "${lines[0]}"
}

# As somebody at the keyboard: the keys come from the X server.
press_keys() {
  "$RENDERSLAB" view gloss.obj --size 200x150 -q --light 'letter_f.tif at=0.3,1.2,0.1 gain=3' \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' >told &
  until xdotool search --onlyvisible --name renderslab windowfocus; do sleep 0.1; done 2>/dev/null
  xdotool search --name renderslab windowsize 220 160
  xdotool key Left key shift+Up key h mousemove 100 75 mousedown 1 mousemove 110 80 mouseup 1 key s
  for ((k = 0; k < 600; ++k)); do
    [ -s told ] && break
    sleep 0.1
  done
  xdotool key q
  wait $!
}

@test "a window, its keyboard and its mouse" {
  display timeout 120 bash -c "$(declare -f press_keys); press_keys"
  [[ $(<told) != *from=0.3,2,-2.2* && $(<told) == *'--size 220x160'* ]]
  made_again "$(<told)"
}

@test "without display or OpenGL 4.3 one line says what is missing and what does without" {
  local lamp=(--light letter_f.tif)
  refuses 1 'no display' 'renderslab image' -- env -u DISPLAY -u WAYLAND_DISPLAY "$RENDERSLAB" view gloss.obj "${lamp[@]}"
  MESA_GL_VERSION_OVERRIDE=3.3 refuses 1 'OpenGL 4.3' 'renderslab image' -- view gloss.obj "${lamp[@]}"
}

@test "keys that are none; a folder that takes no picture" {
  refuses 2 lefft pageup -- view gloss.obj --light letter_f.tif --keys 'left lefft q'
  mkdir gone
  cd gone || return
  rm -r ../gone
  run -1 --separate-stderr view "$BATS_FILE_TMPDIR/gloss.obj" --light "$BATS_FILE_TMPDIR/letter_f.tif" --keys 's q'
  [[ $stderr == *view-1.exr* ]]
  [ -z "$output" ]
}
