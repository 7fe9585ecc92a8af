#!/usr/bin/env bats
# renderslab tradeoff from a lamp script to the picture: what it advises, done again by hand, and
# what is refused. Never how long anything took.
load render

setup_file() {
  needs oiiotool povray
  cd "$BATS_FILE_TMPDIR" || return
  cp "$BATS_TEST_DIRNAME"/scenes/occluder.* .
  # A ball that glows in a black box, open below.
  cat >glow.pov <<'POV'
#version 3.7;
#include "canned.inc"
Canned_Lamp("glow")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 0, 2>, <0, -1, 0>, <-1.5, 1.5, -1.5, 1.5>, 0)
difference {
  box { <-1.1, 0.01, -1.1>, <1.1, 1.5, 1.1> }
  box { <-1, 0, -1>, <1, 1.4, 1> }
  pigment { rgb 0 } finish { diffuse 0 emission 0 }
}
sphere { <0.3, 1, 0>, 0.35 pigment { rgb 1 } finish { emission rgb <1, 0.8, 0.5> diffuse 0 } }
POV
  ways --errors 0.6,0.3 --all --bakes bakes -o ways.tsv --plot ways.svg >words
}

setup() {
  cd "$BATS_FILE_TMPDIR" || return
}

view=(--camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --size 32x24)
light=' at=0,1,0 scale=0.1'

# ways OPTION...: from the script.
ways() { "$RENDERSLAB" tradeoff occluder.obj --light "glow.pov$light" "${view[@]}" "$@"; }

# column NAME [AWK CONDITION]: of ways.tsv.
column() {
  awk -F'\t' -v name="$1" "/^#/ { next } !n { n = NF; for (k = 1; k <= NF; ++k) at[k] = \$k; next }
    { for (k = 1; k <= NF; ++k) f[at[k]] = \$k } ${2:-1} { print f[name] }" ways.tsv
}

# off A B: RMS of the difference over the mean of B, of colours as vectors.
off() {
  values "$1" >one
  values "$2" >other
  paste one other | awk '
    { squares += ($1 - $4)^2 + ($2 - $5)^2 + ($3 - $6)^2; mean += sqrt($4^2 + $5^2 + $6^2); ++n }
    END { printf "%.6f", sqrt(squares/n)/(mean/n) }'
}
values() { # of the first layer
  oiiotool "$1" --subimage 0 --ch R,G,B -d float -o plain.exr
  oiiotool --dumpdata plain.exr | sed -n 's/^ *Pixel (.*): *//p'
}

@test "each error has its way in POV-Ray and in renderslab, and reaches it" {
  [ "$(grep -c '^reference: the finest bake, ' words)" = 1 ]
  for error in 60 30; do
    for renderer in POV-Ray renderslab; do
      grep "^for $error % here, in $renderer: bake --uv [0-9]* --st [0-9]* --rays [0-9]* (" words >line
      # It was tried, and is no more off than was asked for.
      sed -n 's/.* tried: \([0-9.]*\) % off.*/\1/p' line | awk -v most="$error" '{ ++n } !($1 <= most) { exit 1 } END { exit n != 1 }'
    done
  done
  # The table has the words in its head, and as many fields in each row.
  grep '^# ' ways.tsv | sed 's/^# //' | grep -Fxf words | diff - words
  grep -v '^#' ways.tsv | awk -F'\t' '{ if (!n) n = NF; if (NF != n) exit 1 } END { exit NR < 20 }'
  grep -q '<svg' ways.svg
}

@test "what is told holds where it is done by hand, from the bake on" {
  local way uv st rays measured finest
  PATH=$(dirname "$BAKESLAB"):$PATH
  finest=$(sed -n 's/^reference: the finest bake, \([0-9]*\)x[0-9]* positions, \([0-9]*\)x[0-9]* directions, \([0-9]*\) .*/glow-\1x\2-\3/p' words)
  "$RENDERSLAB" image occluder.obj --light "bakes/$finest.tif$light" "${view[@]}" -q -o truth.exr \
    --method reference --tolerance 1e-5 --shadow-edge 1024
  IFS=$'\t' read -r way uv st rays measured < <(awk -F'\t' '!/^#/ && $15 ~ /30%/ && /^include/ { print $1 "\t" $2 "\t" $3 "\t" $4 "\t" $14 }' ways.tsv)
  [ -n "$measured" ]
  bakeslab bake glow.pov -o hand.tif --uv "$uv" --st "$st" --rays "$rays" -q
  # shellcheck disable=SC2086 # several words
  bakeslab ${way/include/include hand.tif} -o hand.inc -q
  "$RENDERSLAB" pov occluder.obj --light "hand.tif$light" "${view[@]}" -q -o hand.pov
  povray +Ihand.pov +W32 +H24 +FE +Ohand.exr -A -D >log 2>&1
  off hand.exr truth.exr >error
  awk -v told="$measured" '{ print $1, told } !($1 > 0.98*told && $1 < 1.02*told) { exit 1 }' error
}

@test "what is predicted is near what is measured, and seconds are sums" {
  paste <(column predicted 'f["measured"] != "-" && f["way"] != "whole lamp"') \
    <(column measured 'f["measured"] != "-" && f["way"] != "whole lamp"') |
    awk '{ ++n } !($1 < 1.5*$2 && $2 < 1.5*$1) { print; exit 1 } END { exit n < 8 }'
  paste <(column first_cpu) <(column bake_cpu) <(column include_cpu) <(column picture_cpu) |
    awk '{ sum = $2 + $3 + $4 } !($1 > 0.99*sum && $1 < 1.01*sum) { print; exit 1 }'
}

# rejects PIECE COMMAND...: exit 1 or 2 with one line that has the piece.
rejects() { refuses '[12]' "$1" -- "$RENDERSLAB" tradeoff "${@:2}"; }

@test "bakes that were kept are found again; older ones than the script are made anew" {
  local before dark=(occluder.obj "${view[@]}" --light 'glow.pov at=0,-1,0 scale=0.1' --bakes bakes)
  before=$(stat -c %y bakes/glow-4x32-4.tif)
  # The lamp is below the floor, which shows with the first bake, not after all.
  rejects 'no light of it reaches' "${dark[@]}"
  [ "$(stat -c %y bakes/glow-4x32-4.tif)" = "$before" ]
  touch glow.pov
  rejects 'no light of it reaches' "${dark[@]}"
  [ "$(stat -c %y bakes/glow-4x32-4.tif)" != "$before" ]
}

@test "bad input" {
  local slab=bakes/glow-4x32-4.tif good=(occluder.obj "${view[@]}" --light "glow.pov$light")
  mkdir -p tmp && export TMPDIR=$PWD/tmp
  # Less than what the slab itself errs by: that, and what would do.
  rejects 'a bake with --uv' occluder.obj "${view[@]}" --light "$slab$light" --errors 1e-4
  # shellcheck disable=SC2154 # run sets stderr
  [[ $stderr =~ 'errs by '[0-9.]+' here itself' ]]
  rejects 'starting POV-Ray alone takes 0.0' "${good[@]}" --time-limit 1e-4
  for errors in 0 -1 nan 2 x '' "0.1," "0.1,,0.2"; do rejects --errors "${good[@]}" "--errors=$errors"; done
  for value in 0 -1 nan x ''; do rejects --time-limit "${good[@]}" "--time-limit=$value"; done
  for value in 0 1.5 x ''; do rejects --pictures "${good[@]}" "--pictures=$value"; done
  rejects 'one light' "${good[@]}" --light "glow.pov$light"
  rejects --bakes occluder.obj "${view[@]}" --light "$slab$light" --errors 0.5 --bakes bakes
  rejects --pictures occluder.obj "${view[@]}" --light "$slab$light" --pictures 2 -o t.tsv
  rejects --methods "${good[@]}" --methods pi
  rejects nothere.pov occluder.obj "${view[@]}" --light "nothere.pov$light"
  rejects nothere.obj nothere.obj "${view[@]}" --light "glow.pov$light"
  rejects glow.pov "${good[@]}" -o glow.pov
  rejects '.svg or .png' "${good[@]}" --plot t.jpg
  echo 'sphere {' >broken.pov
  rejects broken.pov occluder.obj "${view[@]}" --light broken.pov
  refuses 1 'povray cannot be run' -- env PATH="$PWD" "$RENDERSLAB" tradeoff "${good[@]}"
  # No pictures are left lying about.
  [ -z "$(ls tmp)" ]
}
