#!/usr/bin/env bash
# What 4x4 rays a pixel cost where neighbours call for them, against one and against 4x4
# everywhere (a picture of 4 x 4 times the size, averaged): CPU seconds, and the RMS error over the
# mean against 12x12 rays everywhere. The demo's lamp, over figure 3's scene and in the office.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
repeats=${BENCH_REPEATS:-3}
mkdir -p pixels
cd pixels
"$root/render/figures/figure6.sh" mesh .
light=$(cat office.light)
slab=$DEMO/parabolic.tif

declare -A mesh=([figure3]=$root/render/scenes/figure3.obj [office]=office.obj)
declare -A place=([figure3]='at=0,36,0' [office]=$light)
declare -A camera=([figure3]='from=-12,34,-100 at=-2,13,0 fov=52' [office]=$(cat office.camera))

# image NAME SCENE WIDTH HEIGHT OPTION...: NAME.exr, and its cost in NAME.cpu.
image() {
  local name=$1 scene=$2 size=$3x$4
  shift 4
  spend "$name" "$RENDERSLAB" image "${mesh[$scene]}" --light "$slab ${place[$scene]}" \
    --camera "${camera[$scene]}" --size "$size" -o "$name.exr" -q "$@"
}

# means NAME WIDTH HEIGHT: of a larger picture's pixels.
means() { oiiotool "$1.exr" --subimage 0 --ch R,G,B --resize:filter=box "$2x$3" -d float -o "$1-means.exr"; }

# error A B: RMS of the difference over the mean of B, in %.
error() {
  oiiotool "$1" --subimage 0 --ch R,G,B "$2" --sub --dup --mul --echo '{TOP.AVGCOLOR}' "$2" --echo '{TOP.AVGCOLOR}' |
    awk -F, '{ sum[NR] = $1 + $2 + $3 } END { printf "%.2f", 100*sqrt(sum[1]/3)/(sum[2]/3) }'
}

# compare SCENE WIDTH HEIGHT: costs at twice that size, the figure's own.
compare() {
  local scene=$1 width=$2 height=$3 n ratios=()
  for ((n = 0; n < repeats; ++n)); do
    image one "$scene" $((2 * width)) $((2 * height))
    image four "$scene" $((2 * width)) $((2 * height)) --samples 4
    ratios+=("$(calc %.3f "$(cat four.cpu)/$(cat one.cpu)")")
  done
  heading "Rays where pixels call for them: $scene, $((2 * width))x$((2 * height))"
  row 'CPU, --samples 4 over one ray a pixel' "$(spread "${ratios[@]}")" '<= 2.5' \
    "$(holds "$(spread "${ratios[@]}" | cut -d' ' -f1) <= 2.5")"
  image one "$scene" "$width" "$height"
  image four "$scene" "$width" "$height" --samples 4
  image everywhere "$scene" $((4 * width)) $((4 * height))
  image truth "$scene" $((12 * width)) $((12 * height))
  means everywhere "$width" "$height"
  means truth "$width" "$height"
  row "CPU at half that size: --samples 4, 4x4 everywhere" \
    "$(calc %.1f "$(cat four.cpu)/$(cat one.cpu)"), $(calc %.1f "$(cat everywhere.cpu)/$(cat one.cpu)")"
  row 'error in %: one ray, --samples 4, 4x4 everywhere' \
    "$(error one.exr truth-means.exr), $(error four.exr truth-means.exr), $(error everywhere-means.exr truth-means.exr)"
}

compare figure3 240 150
compare office 320 240
