#!/usr/bin/env bash
# What a bake costs against one ordinary image of the same lamp with as many rays: 2^24,
# that is 16x16 x 64x64 samples of 16 rays, or 4096 x 4096 pixels.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
repeats=${BENCH_REPEATS:-3}

uniform=() adaptive=() wall=() others=()
for ((n = 0; n < repeats; ++n)); do
  view middle 4096 0 0
  bake uniform16 --rays 16 --uniform
  bake adaptive16 --rays 16
  uniform+=("$(calc %.3f "$(cat uniform16.cpu)/$(cat middle.cpu)")")
  adaptive+=("$(calc %.3f "$(cat adaptive16.cpu)/$(cat middle.cpu)")")
  wall+=("$(calc %.3f "$(cat adaptive16.wall)*$(nproc)/$(cat adaptive16.cpu)")")
  others+=("$(cat adaptive16.others)")
done
view cell 4096 2.5 2.5

heading "Cost of a bake: the paper's lamp, 2^24 rays, CPU over that of one image of as many"
median() { spread "$@" | cut -d" " -f1; }
row "--uniform, image seen from the aperture's middle" "$(spread "${uniform[@]}")" '<= 1.5' \
  "$(holds "$(median "${uniform[@]}") <= 1.5")"
row '--rays 16, the same image' "$(spread "${adaptive[@]}")" '<= 1.5' \
  "$(holds "$(median "${adaptive[@]}") <= 1.5")"
row '--uniform, image seen from the middle between blockers' \
  "$(calc %.2f "$(cat uniform16.cpu)/$(cat cell.cpu)")"
row '--rays 16, the same image' "$(calc %.2f "$(cat adaptive16.cpu)/$(cat cell.cpu)")"
foreign=$(printf %.0f "$(median "${others[@]}")")
mark=$(holds "$(median "${wall[@]}") <= 1.2")
[ "$foreign" -le 5 ] || mark='(not judged: the machine was busy)'
row "wall time over CPU / $(nproc) jobs; others used $foreign % of the machine" "$(spread "${wall[@]}")" '<= 1.2' "$mark"
row 'CPU seconds: image, --uniform, --rays 16 (last run)' \
  "$(printf '%.1f, %.1f, %.1f' "$(cat middle.cpu)" "$(cat uniform16.cpu)" "$(cat adaptive16.cpu)")"
