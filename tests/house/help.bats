#!/usr/bin/env bats
# What --help says can be used: its examples, in man pages too, and its options, in bash's completion.
load house
load lamp_make

# examples COMMAND...: those of its help, a line each.
examples() { "$@" --help | sed -n '/^Examples/,/^$/ s/^  //p' | sed ':a; /\\$/ { N; s/\\\n *//; ba }'; }

# runs EXAMPLE: it does its work, or is at it after a moment where that is long. `check --strict` may
# warn.
runs() {
  local status=0 seconds=60
  case $1 in *' bake '* | *' view '* | *tradeoff* | *'--mode auto'*) seconds=2 ;; esac
  timeout $seconds bash -c "$1" >out 2>&1 || status=$?
  case $status:$seconds:$1 in
    0:* | 124:2:* | 1:*--strict*) ;;
    *) echo "$1: exit status $status" && cat out && return 1 ;;
  esac
}

# Windows, on a display of their own; keys end those that would wait for some.
shows() {
  local example
  while IFS= read -r example; do
    timeout 60 xvfb-run -a -s '-screen 0 800x600x24 -noreset' bash -c "${example/ view / view --keys q }" >out 2>&1 ||
      { echo "$example" && cat out && return 1; }
  done
}

# stands PAGE COMMAND...: the examples of its help, line by line, in its man page.
stands() {
  local page=$1
  shift
  sh "$ROOT/bakeslab/cli/man.sh" "$1" "$page" 1 | groff -man -Tascii -P-c -rLL=200n | sed 's/.\x08//g' >page.txt
  while IFS= read -r example; do
    grep -qF -- "$example" page.txt || { echo "$page.1 lacks $example"; return 1; }
  done < <("$@" --help | sed -n '/^Examples/,/^$/ s/^  //p')
}

@test "each example runs as it is pasted, and stands so in the man page" {
  needs jq groff help2man xvfb-run
  local name program command example
  cd "$BATS_TEST_TMPDIR"
  PATH=$(dirname "$BAKESLAB"):$PATH
  cp "$CANNED_INCLUDE"/room.* "$ROOT/lamps/parabolic.pov" .
  bakeslab bake parabolic.pov -o lamp.tif --uv 8 --st 64 --rays 1 -q
  cp parabolic.pov lamp.pov
  # Soft ones, which few lights are enough for.
  some_lamp desk_lamp '#declare Glow = 1;'
  bakeslab bake desk_lamp.pov -o desk_lamp.tif --uv 4 --st 16 --rays 4 -q
  cp desk_lamp.tif street_lamp.tif
  for name in IMG_2001 before after logluv; do cp lamp.tif $name.tif; done
  bakeslab convert lamp.tif -o lamp.exr && cp lamp.exr float.exr
  mkdir lamps && cp lamp.tif lamps
  oiiotool --create 64x48 3 --fill:color=0.9,0.5,0.1 32x48+0+0 -o slide.png -o film.jpg
  echo '0 -1 0  0 -1 0' | tee rays.txt >receivers.txt
  printf '%s 0 0 %s 0.1 1 1\n' -0.5 0.2 0.5 -0.2 0.1 0.3 0 0 >led.txt
  cp led.txt led.tm25ray # what a file is, its content tells
  cp "$ROOT/lamps/wall_washer.ies" downlight.ies
  cp downlight.ies trough.ldt
  oiiotool --create 4x4 3 --fill:color=1,1,1 4x4 -d float -o view_00_00.exr
  oiiotool --create 4x4 3 --fill:color=2,1,1 4x4 -d float -o view_01_00.exr
  printf '{"fl_x": 9, "frames": [{"file_path": "view_00_00", "transform_matrix": [[1,0,0,0],[0,-1,0,0],[0,0,-1,-1]]},
    {"file_path": "view_01_00", "transform_matrix": [[1,0,0,0.1],[0,-1,0,0.1],[0,0,-1,-1]]}]}' >transforms.json
  mkdir one two
  bakeslab bake parabolic.pov -o one/night.tif --uv 2 --st 4 --rays 1 --shard 1/2 -q
  bakeslab bake parabolic.pov -o two/night.tif --uv 2 --st 4 --rays 1 --shard 2/2 -q
  cp -r one/night.tif.partial .
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    for command in $(commands "$program"); do
      examples "$program" "$command" >lines
      [ -s lines ] || { echo "$command has none"; false; }
      while IFS= read -r example; do
        [[ $example == *' view '* ]] || runs "$example"
      done <lines
      stands "${program##*/}-$command" "$program" "$command"
    done
    stands "${program##*/}" "$program"
  done
  examples "$RENDERSLAB" view | shows
}

# completed WORD...: what bash completes the last of them to.
completed() {
  # shellcheck disable=SC2034 # bash's completion reads them
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  "_$1"
  printf '%s\n' "${COMPREPLY[@]}" | sort | paste -sd ' '
}

@test "bash completes commands, options, their words and kinds of files" {
  local program name command option
  cd "$BATS_TEST_TMPDIR"
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    sh "$ROOT/bakeslab/cli/completion.sh" "$program" >completion
    # shellcheck source=/dev/null
    source ./completion
  done
  touch a.tif b.exr c.obj d.glb e.pov f.txt g.png
  [ "$(completed renderslab im)" = image ]
  [ "$(completed bakeslab help pro)" = projector ]
  [ "$(completed renderslab image --shadow-g)" = '--shadow-grid= --shadow-groups=' ]
  [ "$(completed renderslab image --method pa)" = 'paper paper-levels' ]
  [ "$(completed bakeslab convert --precision = f)" = float ]
  [ "$(completed renderslab image '')" = 'c.obj d.glb' ]
  [ "$(completed renderslab view c.obj --light "'")" = 'a.tif b.exr' ]
  [ "$(completed renderslab image -o '')" = 'b.exr g.png' ]
  [ "$(completed bakeslab bake '')" = e.pov ]
  [ "$(completed renderslab image --size '')" = '' ]
  # Every option of every command.
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    for command in $(commands "$program"); do
      for option in $("$program" "$command" --help | sed '/^Examples/,$d' | sed -nE 's/^ +(-., )*(--[a-z][a-z-]*).*/\2/p'); do
        [[ "$(completed "${program##*/}" "$command" "$option")" == "$option"* ]] || { echo "$command $option"; false; }
      done
    done
  done
}
