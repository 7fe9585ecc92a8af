#!/usr/bin/env bash
# Exported lamps in other renderers, where `make engines` has installed them: single rays, the
# irradiance of 32x32 receivers against samples, and how many samples a thin beam takes.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p export && cd export
tests=$TOOLS/../export

# told PROGRAM [ENGINE SETTING]: its lines about lamps, of one engine only and at another setting,
# in rows; of engines that are not there, that.
told() {
  local line
  (cd "$root" && ${3+env "ENGINE=$2" "SETTING=$3"} "$tests/$1") >"$1.log" 2>&1 || tail -n 3 "$1.log"
  sed -nE 's/^# (.*: (rays|irradiance) by .*|.* is not installed)$/\1/p' "$1.log" | sed 's/^skipped: //' | sort -u |
    while read -r line; do row "${line%[:,] *}" "${line##*[:,] }"; done
}

heading 'Single rays into exported lamps, 4000 each: the largest difference, by the peak'
told test_radiance
told test_pages

heading 'Irradiance of 32x32 receivers one unit before exported lamps'
told test_light

heading 'Error against samples: RMS and CPU seconds, Python and loading included'
for samples in 64 256 4096; do
  told test_light mitsuba "samples=$samples"
  told test_light cycles "$samples"
done
for ds in 0.02 0.005; do told test_light radiance "-ds $ds -dj 0 -dt 0 -dc 1"; done

# ---- A thin beam

# off Z SAMPLES SAMPLING: RMS error of Mitsuba at the receivers-Z, in %.
off() {
  awk '{ print $1, $2, -$3, $4, $5, -$6 }' "receivers-$1" |
    (cd "$root" && "${MITSUBA_PYTHON:-python3}" tests/export/mitsuba_rays.py "$BUILD/export/torch" torch irradiance \
      "samples=$2" "sampling=$3") | paste -d ' ' - "reference-$1" |
    awk '{ for (c = 1; c <= 3; ++c) { d += ($c - $(c + 3))^2; e += $(c + 3)^2 } } END { print 100*sqrt(d/e) }'
}

# needed Z SAMPLING: samples to an error of 2 %, between powers of 4.
needed() {
  local samples error
  for samples in 4 16 64 256 1024 4096; do
    error=$(off "$1" "$samples" "$2")
    echo "$samples $error"
    awk -v e="$error" 'BEGIN { exit !(e < 2) }' && break
  done | awk '{ n[NR] = log($1); e[NR] = log($2) }
    END { printf "%.0f", exp(n[NR - 1] + (n[NR] - n[NR - 1])*(e[NR - 1] - log(2))/(e[NR - 1] - e[NR])) }'
}

heading 'A thin beam in Mitsuba, the torch: multijitter samples for 2 %'
if ! "${MITSUBA_PYTHON:-python3}" "$root/tests/export/mitsuba_rays.py" irradiance 2>/dev/null; then
  row 'Mitsuba with LLVM is not installed: make engines' -
  exit
fi
[ -f torch.tif ] || "$BAKESLAB" bake "$root/lamps/torch.pov" -o torch.tif --uv 16 --st 64 --rays 16 --yes -q
"$BAKESLAB" export torch.tif -o torch --as mitsuba --force -q
for at in 120,40 1000,150; do
  z=${at%,*}
  awk -v z="$z" -v half="${at#*,}" 'BEGIN { for (k = 0; k < 576; ++k)
    print ((k%24 + 0.5)/12 - 1)*half, ((int(k/24) + 0.5)/12 - 1)*half, z, 0, 0, -1 }' >"receivers-$z"
  "$RENDERSLAB" irradiance --light torch.tif --method reference --tolerance 1e-4 <"receivers-$z" >"reference-$z"
  energy=$(needed "$z" energy) visible=$(needed "$z" visible)
  row "$z mm away: by the slab's light" "$energy"
  row "$z mm away: evenly over what is seen" "$visible"
  row "$z mm away: ratio" "$(calc %.2f "$energy/$visible")" '<= 0.5' "$(holds "$energy <= 0.5*$visible")"
done
