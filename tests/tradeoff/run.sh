#!/usr/bin/env bash
# What `make tradeoff` does: three lamps in three scenes, by renderslab tradeoff from the lamp's
# script on; and the bake's resolution against the error of a floor. Tables and plots go to $BUILD.
set -euo pipefail
# shellcheck source=tests/tradeoff/tradeoff.bash
. "$(dirname "$0")/tradeoff.bash"

# Beams of mirrors and lenses need finer slabs than soft light does: a bake for 5 % takes hours.
declare -A errors=([desk_lamp]='0.5,0.2,0.1,0.05,0.02' [parabolic]='0.5,0.3,0.2' [torch]='0.5,0.3,0.2')

# ways LAMP SCENE: the cheapest way to each error, from the lamp's script to the picture: words,
# table and plots. What a lamp's bakes took is kept for the scenes that follow.
ways() {
  local lamp=$1 scene=$2
  echo "$lamp, $scene"
  "$RENDERSLAB" tradeoff "$scene.obj" --light "$root/lamps/$lamp.pov ${places[$scene]} toward=0,0,0 up=0,0,1" \
    --camera "${cameras[$scene]}" --size 320x240 --errors "${errors[$lamp]}" --bakes bakes \
    -o "$lamp-$scene.tsv" --plot "$lamp-$scene.png" | tee "$lamp-$scene.txt"
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
    [ -f "$name.cpu" ] || cpu_of "$name.cpu" "$BAKESLAB" bake "$root/lamps/parabolic.pov" -o "$name.exr" --window declared \
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
"$here/plots.sh"
# A diffuse reflector; a mirror; a lens, by photons. What cannot be reached is told, and the others
# follow.
status=0
for lamp in desk_lamp parabolic torch; do
  for scene in far office near; do ways "$lamp" "$scene" || status=1; done
done
echo "Look at desk_lamp-office.png, resolution.png and the others, in $BUILD"
exit "$status"
