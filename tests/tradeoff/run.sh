#!/usr/bin/env bash
# What `make tradeoff` does: three lamps in three scenes, by renderslab tradeoff and by POV-Ray
# with the include at 16, 8, 4 and 1 lights a side; and the bake's resolution against the error
# of a floor. Tables and plots go to $BUILD, which holds parabolic.tif already.
set -euo pipefail
# shellcheck source=tests/tradeoff/tradeoff.bash
. "$(dirname "$0")/tradeoff.bash"

# pov LAMP SCENE: PREFIX-pov.tsv, like the table of renderslab tradeoff. CPU seconds are those
# over a picture of 2 x 2 pixels, which reads the same files.
pov() {
  local lamp=$1 scene=$2 prefix=$1-$2 size=${sizes[$2]} n cpu rms most start factor wide
  local macro=${lamp^}
  "$RENDERSLAB" image "$scene.obj" --light "$lamp.tif ${places[$scene]}" --camera "${cameras[$scene]}" \
    --size "$size" --method reference --shadow-edge 1024 -q -o "$prefix-layers.exr"
  plain "$prefix-layers.exr" "$prefix-reference.exr"
  "$RENDERSLAB" pov "$scene.obj" --light "$lamp.tif ${places[$scene]}" --camera "${cameras[$scene]}" \
    --size "$size" -q -o "$prefix.pov"
  printf '# POV-Ray 3.7 with %s.inc at N x N lights; errors against renderslab reference\nlights\tcpu\trms\tmax\n' \
    "$lamp" >"$prefix-pov.tsv.new"
  for n in 16 8 4 1; do
    # Few lights take less than the clock can tell: 16 times the pixels then.
    factor=1
    [ "$n" -gt 4 ] || factor=4
    wide=$((${size%x*} * factor))x$((${size#*x} * factor))
    povray_cpu "$prefix-$n.exr" "$prefix.pov" "$size" "Declare=${macro}_Lights=$n" >/dev/null
    start=$(povray_cpu "$prefix-time.exr" "$prefix.pov" 2x2 "Declare=${macro}_Lights=$n")
    cpu=$(povray_cpu "$prefix-time.exr" "$prefix.pov" "$wide" "Declare=${macro}_Lights=$n")
    read -r rms most < <("$LAMPS" compare "$prefix-$n.exr" "$prefix-reference.exr")
    awk -v n="$n" -v cpu="$cpu" -v start="$start" -v rms="$rms" -v most="$most" -v factor="$factor" \
      'BEGIN { t = (cpu - start)/factor^2; printf "%d\t%.3g\t%s\t%s\n", n, (t > 1e-4 ? t : 1e-4), rms, most }' >>"$prefix-pov.tsv.new"
  done
  mv "$prefix-pov.tsv.new" "$prefix-pov.tsv"
}

# resolution UV ST: a line of the table. The truth and exact means of cells are by the ray
# caster of tests/bench; ideal slabs tell what the resolution alone does. Small ones are baked
# too, by POV-Ray.
resolution() {
  local uv=$1 st=$2 name=resolution-$1-$2 ideal baked=- cpu=-
  # 2^28 rays in all: as many for each floor.
  "$FLOOR" truth "$name.bin" "$uv" "$st" $((268435456 / (uv * uv * st * st))) >/dev/null
  read -r ideal _ < <("$FLOOR" ideal "$name.bin")
  if [ "$uv" -le 16 ] && [ "$st" -le 64 ]; then
    [ -f "$name.cpu" ] || cpu_of "$name.cpu" "$BAKESLAB" bake "$root/lamps/parabolic.pov" -o "$name.exr" \
      --uv "${uv}x$uv" --st "${st}x$st" --effects none --jobs 1 --quiet
    read -r baked _ < <("$FLOOR" compare "$name.bin" "$name.exr")
    cpu=$(cat "$name.cpu")
  fi
  rm "$name.bin"
  printf '%d\t%d\t%d\t%s\t%s\t%s\n' "$uv" "$st" $((uv * uv * st * st)) "$ideal" "$baked" "$cpu" >"$name.row"
}

all_resolutions() {
  local uv st
  for st in 128 64 32; do for uv in 32 16 8; do
    while [ "$(jobs -rp | wc -l)" -ge "$(nproc)" ]; do wait -n; done
    resolution "$uv" "$st" &
  done; done
  wait
  {
    echo "# The floor 3 apertures below the paper's lamp, its bulb alone: relative RMS error of its"
    echo "# irradiance in %, by means over the slab's cells of 2^28 rays in all, and baked with 16 rays a sample"
    printf 'uv\tst\tsamples\tcell_means\tbaked\tbake_cpu\n'
    cat resolution-*.row | sort -n
  } >resolution.tsv
  rm resolution-*.row
}

prepare
all_resolutions
"$here/plots.sh" resolution
for scene in far office near; do
  for lamp in smooth peaks parabolic; do
    echo "$lamp, $scene"
    "$RENDERSLAB" tradeoff "$scene.obj" --light "$lamp.tif ${places[$scene]}" --camera "${cameras[$scene]}" \
      --size "${sizes[$scene]}" --finest 1e-3 -o "$lamp-$scene.tsv"
    pov "$lamp" "$scene"
    "$here/plots.sh" scene "$lamp" "$scene"
  done
done
"$here/plots.sh" main
echo "Look at $(basename "$BUILD")/main.png, resolution.png and the others, in $BUILD"
