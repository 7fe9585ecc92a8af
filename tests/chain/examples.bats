#!/usr/bin/env bats
# Includes work in scenes that this project did not write: three of POV-Ray's own examples
# (Debian's povray-examples), of #version 3.6 and 3.7, with assumed_gamma 2.2, 1.3 and 1, with
# mirrors, a shadowless light, blobs and a sky. The lamp's light adds to what is there and changes nothing else.

examples=/usr/share/doc/povray/examples

setup_file() {
  cd "$BATS_FILE_TMPDIR" || return
  load ../render/render
  needs oiiotool
  letter_slab letter_f.tif letter_f 4 3 '"center": [0, 0, 0], "u": [2, 0, 0], "v": [0, 0, 1.6], "normal": [0, -1, 0], "st_window": [-1, 1, -1.2, 0.9]'
  "$BAKESLAB" include letter_f.tif -o letter_f.inc
  "$BAKESLAB" include letter_f.tif -o cluster.inc --mode cluster --lights 8
}

setup() {
  load ../render/render
  cd "$BATS_FILE_TMPDIR" || return
  [ -d "$examples" ] || { echo "povray-examples is missing: run make setup"; return 1; }
}

# scene NAME INCLUDE EXAMPLE PLACE: NAME.pov, the example with the lamp; Gain is declared.
scene() {
  cat >"$1.pov" <<POV
#include "$3.pov"
#declare Version_Before = version;
#include "$2"
object { Letter_F_Canned(1, Gain) $4 }
#if (version != Version_Before) #error "the include changed #version\n" #end
POV
}

# rendered NAME SCENE OPTION...: NAME.exr, with radiance as the scene's colours.
rendered() {
  local name=$1 scene=$2
  shift 2
  povray "+I$scene" "+O$name.exr" +W48 +H36 -A -D +FE +WT1 "+L$folder" "$@" >"$name.log" 2>&1 ||
    { tail -n 20 "$name.log"; return 1; }
}

# As POV-Ray adds colours up: without the gamma that it takes off for the file.
linear() { oiiotool "$1.exr" --ch R,G,B --powc "$(awk -v g="$gamma" 'BEGIN { print 1/g }')" -d float -o "$1.lin.exr"; }

# lights EXAMPLE GAMMA GAIN PLACE
lights() {
  local name folder gamma=$2 include
  name=$(basename "$1")
  folder=$examples/$(dirname "$1")
  rendered "$name" "$folder/$name.pov"
  for include in letter_f cluster; do
    scene "$name-lit" "$include.inc" "$name" "$4"
    # Dark, it changes no bit.
    rendered "$name-0" "$name-lit.pov" Declare=Gain=0
    oiiotool "$name-0.exr" "$name.exr" --diff >/dev/null || { echo "$include.inc with Gain 0 changes $name"; return 1; }
    # Lit, it makes pixels brighter, and twice as bright with twice the Gain.
    rendered "$name-1" "$name-lit.pov" "Declare=Gain=$3"
    rendered "$name-2" "$name-lit.pov" "Declare=Gain=$(awk -v g="$3" 'BEGIN { print 2*g }')"
    for k in 0 1 2; do linear "$name-$k"; done
    for k in 1 2; do oiiotool "$name-$k.lin.exr" "$name-0.lin.exr" --sub -d float -o "$name-added$k.exr"; done
    oiiotool "$name-added1.exr" --mulc 2 -d float -o "$name-twice.exr"
    added=$(oiiotool "$name-added1.exr" --echo '{TOP.AVGCOLOR} {TOP.MINCOLOR}' | tr , ' ')
    before=$(oiiotool "$name-0.lin.exr" --echo '{TOP.AVGCOLOR}' | tr , ' ')
    echo "# $name, $include: added $added (mean, least) to $before"
    awk -v added="$added" -v before="$before" 'BEGIN {
      split(added, a, " "); split(before, b, " ")
      for (k = 1; k <= 3; ++k) if (!(a[k] > 0.05*b[k] && a[k + 3] >= 0)) exit 1 }'
    error=$(relative "$name-twice.exr" "$name-added2.exr")
    echo "# twice the Gain: $error % off"
    below "$error" 0.1
  done
}

@test "a mirroring teapot, #version 3.6, assumed_gamma 2.2" {
  lights advanced/teapot/teapot 2.2 50 'rotate -50*x translate <-2, 5, -6>'
}

@test "a biscuit, #version 3.6, assumed_gamma 1.3, a shadowless light" {
  lights advanced/biscuit 1.3 120 'rotate -45*x translate <0, 14, -18>'
}

@test "boxes and a ball under a sky, #version 3.7, assumed_gamma 1" {
  lights camera/perspective 1 300 'translate <0, 25, 0>'
}
