#!/usr/bin/env bash
# What each kind of include costs and errs: sheets of 16, 8 and 4 lights a side, clusters of 4,
# 16 and 64 area lights, and the far field as one point, for four lamps. A square as wide as 8
# apertures, 4 apertures away, bare and with a ball between; errors are those of POV-Ray's
# picture against renderslab's reference from the same slab. Beside them the lamp's whole
# geometry over the bare square, with what it calls for; its error is mostly noise.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p includes
BUILD=$BUILD/includes
# shellcheck source=tests/tradeoff/tradeoff.bash
. "$root/tests/tradeoff/tradeoff.bash"
size=160x120 away=4
declare -A calls_for=([torch]='caustics extended_source') # the others: interreflection
modes=('sheet 16' 'sheet 8' 'sheet 4' 'cluster 4' 'cluster 16' 'cluster 64' 'point 1')

# scenes LAMP: bare.obj and ball.obj before page 1, and camera.txt. Meshes have z mirrored.
scenes() {
  "$BAKESLAB" info "$1.tif" | awk -v away="$away" '
    function at(a, b, c) { return x[1] + a*u[1] + b*v[1] + c*n[1] " " x[2] + a*u[2] + b*v[2] + c*n[2] " " (-(x[3] + a*u[3] + b*v[3] + c*n[3])) }
    function comma(a, b, c) { return x[1] + a*u[1] + b*v[1] + c*n[1] "," x[2] + a*u[2] + b*v[2] + c*n[2] "," x[3] + a*u[3] + b*v[3] + c*n[3] }
    $1 == "center" && !done { for (k = 1; k <= 3; ++k) x[k] = $(k + 1) }
    $1 == "u" && !done { for (k = 1; k <= 3; ++k) u[k] = $(k + 1) }
    $1 == "v" && !done { for (k = 1; k <= 3; ++k) v[k] = $(k + 1) }
    $1 == "normal" && !done { for (k = 1; k <= 3; ++k) n[k] = $(k + 1); done = 1 }
    END {
      lu = sqrt(u[1]^2 + u[2]^2 + u[3]^2); lv = sqrt(v[1]^2 + v[2]^2 + v[3]^2); w = (lu > lv ? lu : lv)
      for (k = 1; k <= 3; ++k) { u[k] *= w/lu; v[k] *= w/lv; n[k] *= w }
      print "usemtl white" >"bare.obj"
      for (k = 0; k < 4; ++k) print "v " at((k == 1 || k == 2 ? 4 : -4), (k > 1 ? 4 : -4), away) >"bare.obj"
      print "f 1 2 3 4" >"bare.obj"
      # The ball, off the middle, of half the radius of the aperture.
      N = 32
      for (j = 0; j <= N/2; ++j) for (i = 0; i < N; ++i) {
        t = j*6.2831853/N; p = i*6.2831853/N
        print "v " at(0.5 + 0.4*sin(t)*cos(p), 0.3 + 0.4*sin(t)*sin(p), 0.6*away + 0.4*cos(t)) >"ball.part"
      }
      for (j = 0; j < N/2; ++j) for (i = 0; i < N; ++i) {
        a = 5 + j*N + i; b = 5 + j*N + (i + 1)%N
        if (j > 0) print "f " a, b, b + N >"ball.part"
        if (j < N/2 - 1) print "f " a, b + N, a + N >"ball.part"
      }
      print "#declare Square = polygon { 4" >"square.inc"
      for (k = 0; k < 4; ++k) print ", <" comma((k == 1 || k == 2 ? 4 : -4), (k > 1 ? 4 : -4), away) ">" >"square.inc"
      print " }" >"square.inc"
      printf "from=%s at=%s up=%g,%g,%g fov=80", comma(0, -3, 0.8), comma(0, 0.4, away), v[1], v[2], v[3] >"camera.txt"
    }'
  { echo "mtllib room.mtl"; cat bare.obj; } >scene.part
  mv scene.part bare.obj
  cat bare.obj ball.part >ball.obj
  rm ball.part
}

# lit LAMP SCENE: PREFIX-reference.exr, and PREFIX.pov for all kinds of includes.
lit() {
  local lamp=$1 scene=$2 camera
  camera=$(cat camera.txt)
  "$RENDERSLAB" image "$scene.obj" --repair --light "$lamp.tif" --camera "$camera" --size "$size" \
    --method reference --tolerance 1e-4 --shadow-edge 1024 -q -o layers.exr
  plain layers.exr "$lamp-$scene-reference.exr"
  "$RENDERSLAB" pov "$scene.obj" --repair --light "$lamp.tif" --camera "$camera" --size "$size" -q -o "$lamp-$scene.pov"
}

# Error in %, of a picture against the reference.
error() {
  local rms
  read -r rms _ < <("$LAMPS" compare "$1" "$2")
  calc %.2g "100*$rms"
}

# whole LAMP: LAMP-whole.pov, the square under the lamp itself. Its light alone is wanted: rays
# that gather do not see the square (see include-pov/demo.pov).
whole() {
  local effects=${calls_for[$1]-extended_source}
  cat >"$1-whole.pov" <<POV
#version 3.7;
#declare Canned_Bake_Effects = "$effects";
#declare Canned_Bake_Photons = 4000000;
#include "$1.pov"
#include "square.inc"
object { Square pigment { rgb 0.8 } finish { diffuse 1 ambient 0 } no_radiosity }
$([ "$effects" = extended_source ] && cat <<'RADIOSITY'
global_settings {
  max_trace_level 12
  radiosity {
    pretrace_start 0.08 pretrace_end 0.01
    count 6400, 64000 error_bound 0.2 nearest_count 10 recursion_limit 3
    low_error_factor 0.7 minimum_reuse 0.01 gray_threshold 0 brightness 1
  }
}
RADIOSITY
)
#include "camera.inc"
POV
  sed -n '/^camera/,/^}/p' "$1-bare.pov" >camera.inc
  spend "$1-whole" povray "+I$1-whole.pov" +Owhole.exr "+W${size%x*}" "+H${size#*x}" +FE -A -D +WT1 \
    "+L$CANNED_INCLUDE" "+L$root/lamps"
  printf '  %-12s %-12s %10s %10s %10s\n' "$1" 'whole lamp' "$(error whole.exr "$1-bare-reference.exr")" - "$(cat "$1-whole.cpu")"
}

lamp_table() {
  local lamp=$1 mode kind n start cpu options
  [ "$lamp.tif" -nt "$root/lamps/$lamp.pov" ] ||
    "$BAKESLAB" bake "$root/lamps/$lamp.pov" -o "$lamp.tif" --uv 16x16 --st 48x48 --rays 4 -q
  "$BAKESLAB" include "$lamp.tif" -o "$lamp.inc" -q # which `renderslab pov` looks for
  scenes "$lamp"
  lit "$lamp" bare
  lit "$lamp" ball
  for mode in "${modes[@]}"; do
    read -r kind n <<<"$mode"
    options=(--mode "$kind")
    [ "$kind" = point ] || options+=(--lights "$n")
    "$BAKESLAB" include "$lamp.tif" -o "$lamp.inc" -q "${options[@]}"
    povray_cpu bare.exr "$lamp-bare.pov" "$size" "+L$BUILD" >cpu.txt
    start=$(povray_cpu start.exr "$lamp-bare.pov" 2x2 "+L$BUILD")
    cpu=$(calc %.2g "$(cat cpu.txt) - $start")
    povray_cpu ball.exr "$lamp-ball.pov" "$size" "+L$BUILD" >/dev/null
    printf '  %-12s %-12s %10s %10s %10s\n' "$lamp" "$mode" "$(error bare.exr "$lamp-bare-reference.exr")" \
      "$(error ball.exr "$lamp-ball-reference.exr")" "$cpu"
  done
  whole "$lamp"
}

cp "$root/tests/tradeoff/room.mtl" .
heading "Includes of four lamps, $size pixels, a square 4 apertures away: error in %, CPU seconds"
printf '  %-12s %-12s %10s %10s %10s\n' lamp include bare 'a ball' 'CPU s'
for lamp in desk_lamp fluorescent parabolic torch; do lamp_table "$lamp"; done
