#!/usr/bin/env bash
# What accuracy costs in time: half the resolution, the method auto and the cut in the nine
# pairs of a lamp and a scene of `make tradeoff`, limits of time, and cost against the slab's
# size and the distance. CPU time, medians.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p "$BUILD/tradeoff"
BUILD=$BUILD/tradeoff
# shellcheck source=tests/tradeoff/tradeoff.bash
. "$root/tests/tradeoff/tradeoff.bash"
ln -sfn "$DEMO/parabolic.tif" parabolic.tif
prepare

# All that the program knows, but those as published: they are never the cheapest.
methods=$({ "$RENDERSLAB" image x --method "?" 2>&1 || :; } | sed 's/.*there are //; s/ //g; s/paper-levels//; s/paper,//; s/,,*/,/g; s/,$//')

# sums TABLE MESH LIGHT CAMERA OPTION...: renderslab tradeoff without shadows.
sums() {
  local table=$1 mesh=$2 light=$3 camera=$4
  shift 4
  "$RENDERSLAB" tradeoff "$mesh" --light "$light" --camera "$camera" --no-shadows -q -o "$table" "$@"
}

# ---- Half the resolution ----

figure3=(--camera 'from=-12,34,-100 at=-2,13,0 fov=52' --size 160x100 --method reference -q)
full=$root/build/figures/parabolic.tif half=32
[ -f "$full" ] || { full=parabolic.tif half=8; }
"$BAKESLAB" convert "$full" -o half.tif --uv "${half}x$half" --st 32x32 -q
heading "The paper's figure 3, a slab of $((2 * half)) x $((2 * half)) positions and half the resolution in each direction; CPU seconds"
"$root/render/figures/figure3.sh" factors "$full" half.tif
"$RENDERSLAB" image "$root/render/scenes/figure3.obj" --light "$full at=0,36,0" "${figure3[@]}" -o layers.exr
plain layers.exr full.exr
"$RENDERSLAB" image "$root/render/scenes/figure3.obj" --light "half.tif at=0,36,0" "${figure3[@]}" -o layers.exr
plain layers.exr half.exr
read -r rms most < <("$LAMPS" compare half.exr full.exr)
row 'the converted slab changes the picture by: relative RMS, at most' "$rms, $most"

# ---- auto, and the cut, in nine pairs ----

heading 'auto against the cheapest method in hindsight whose largest error is within the tolerance; sums alone'
printf '  %-18s %9s %10s %12s %10s %8s  %s\n' 'lamp, scene' tolerance 'auto, s' 'its error' 'best, s' ratio 'the best: method, tolerance, level'
worst=0 broken=0 pairs=()
for scene in near office far; do for lamp in smooth peaks parabolic; do
  table=$lamp-$scene.tsv
  pairs+=("$lamp-$scene")
  sums "$table" "$scene.obj" "$lamp.tif ${places[$scene]}" "${cameras[$scene]}" \
    --size 128x96 --finest 1e-3 --methods "$methods" --levels 2
  for tolerance in 0.01 0.001; do
    read -r auto error < <(rows "$table" 'f["cpu"] " " f["sum_max"]' \
      "f[\"method\"] == \"auto\" && f[\"tolerance\"] == $tolerance")
    broken=$(calc %d "$broken + ($error > $tolerance)")
    read -r best name < <(rows "$table" 'f["cpu"] " " f["method"] " " f["tolerance"] " " f["level"]' \
      "f[\"method\"] != \"auto\" && f[\"sum_max\"] <= $tolerance" | sort -g | head -n 1)
    ratio=$(calc %.2f "$auto/$best")
    worst=$(calc %.2f "$ratio > $worst ? $ratio : $worst")
    printf '  %-18s %9s %10s %12s %10s %8s  %s\n' "$lamp, $scene" "$tolerance" "$auto" "$error" "$best" "$ratio" "$name"
  done
done; done
row 'auto over the best, the worst of them' "$worst" '<= 1.3' "$(holds "$worst <= 1.3")"
row 'auto: largest errors above the tolerance' "$broken" 0 "$(holds "$broken == 0")"

# A row of a method with a tolerance; "" where the program has no such method.
timed() { rows "$1.tsv" 'f["cpu"] " " f["sum_max"]' "f[\"method\"] == \"$2\" && f[\"tolerance\"] == \"$3\""; }

heading 'The cut, over all receivers of 128 x 96 pixels: its largest error, and CPU time over that of others'
if [ -z "$(timed "${pairs[0]}" cut 0.01)" ]; then
  echo '  (there is no method cut)'
else
  declare -A bound=([near]=1 [office]=0.1 [far]=0.02)
  printf '  %-18s %9s %10s %12s %8s %10s  %s\n' 'lamp, scene' tolerance error '/reference' '/pi' receivers ''
  for pair in "${pairs[@]}"; do
    receivers=$(sed -n 's/.*of which \([0-9]*\) pixels.*/\1/p' "$pair.tsv")
    for tolerance in 0.01 0.001; do
      read -r cut error < <(timed "$pair" cut "$tolerance")
      read -r reference _ < <(timed "$pair" reference "$tolerance")
      read -r pi _ < <(timed "$pair" pi -)
      limit=1
      [ "$tolerance" = 0.001 ] || limit=${bound[${pair#*-}]}
      printf '  %-18s %9s %10s %12s %8s %10s  %s\n' "${pair/-/, }" "$tolerance" "$error" \
        "$(calc %.3f "$cut/$reference")" "$(calc %.3f "$cut/$pi")" "$receivers" \
        "error $(holds "$error <= $tolerance"), time <= $limit: $(holds "$cut/$reference <= $limit"), <= pi: $(holds "$cut <= $pi")"
    done
  done
fi

# ---- Limits of time ----

heading 'A limit of time: seconds on the wall, the near scene at 240x180, one run each'
for seconds in 2 5; do
  start=$(date +%s.%N)
  "$RENDERSLAB" image near.obj --light "parabolic.tif ${places[near]}" --camera "${cameras[near]}" --size 240x180 \
    --tolerance 1e-9 --time-limit "$seconds" -o limit.exr 2>limit.log
  took=$(calc %.2f "$(date +%s.%N) - $start")
  row "--time-limit $seconds: $(sed -n 's/.*relative error at/error at/p' limit.log)" "$took" '+-10 %' \
    "$(holds "$took <= 1.1*$seconds && $took >= 0.9*$seconds")"
done

# ---- Cost against size and distance ----

# cost_table LABEL X...: us a receiver of each method in LABEL-X.tsv, and the slope of a line
# through the logarithms.
cost_table() {
  local label=$1 x receivers
  shift
  for x in "$@"; do
    receivers=$(sed -n 's/.*of which \([0-9]*\) pixels.*/\1/p' "$label-$x.tsv")
    rows "$label-$x.tsv" "f[\"method\"] \" \" f[\"tolerance\"] \" $x \" 1e6*f[\"cpu\"]/$receivers" \
      'f["tolerance"] == "-" || f["tolerance"] == "0.01"'
  done | awk -v xs="$*" '
    { name = $1 ($2 == "-" ? "" : " " $2); if (!(name in n)) order[++names] = name
      ++n[name]; cell[name, $3] = $4; x = log($3); y = log($4); sx[name] += x; sy[name] += y; sxx[name] += x*x; sxy[name] += x*y }
    END {
      count = split(xs, at, " ")
      printf "  %-18s", "us a receiver"; for (k = 1; k <= count; ++k) printf " %9s", at[k]; printf " %8s\n", "slope"
      for (m = 1; m <= names; ++m) {
        name = order[m]; printf "  %-18s", name
        for (k = 1; k <= count; ++k) printf " %9.3g", cell[name, at[k]]
        d = n[name]*sxx[name] - sx[name]^2
        printf " %8.2f\n", (d > 0 ? (n[name]*sxy[name] - sx[name]*sy[name])/d : 0)
      }
    }'
}
priced=$(sed 's/levels,*//; s/views,*//; s/,$//' <<<"$methods")

heading 'Cost against the size of the slab: N x N x N x N samples, a smooth lamp, the office'
sides=(8 16 32 64)
for side in "${sides[@]}"; do
  "$LAMPS" smooth sized.tif "$side" "$side"
  sums "size-$side.tsv" office.obj "sized.tif ${places[office]}" "${cameras[office]}" --size 80x60 --finest 0.01 --methods "$priced"
done
rm sized.tif
cost_table size "${sides[@]}"

heading "Cost against the distance, in apertures: a floor of 2.4 distances, the paper's lamp at 16x16 x 64x64"
far=(0.25 1 4 16 64 256)
for distance in "${far[@]}"; do
  height=$(calc %g "20*$distance")
  "$LAMPS" floor floor.obj "$(calc %g "48*$distance")"
  sums "distance-$distance.tsv" floor.obj "parabolic.tif at=0,$height,0" \
    "from=0,$(calc %g "1.5*$height"),0 at=0,0,0 up=0,0,1 fov=70" --size 80x60 --finest 0.01 --methods "$priced"
done
cost_table distance "${far[@]}"
