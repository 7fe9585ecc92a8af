#!/usr/bin/env bash
# Lamps through files and back: as .ies by bakeslab export and import, and as TM-25 rays. Intensities
# are those of renderslab a million metres away, in 1000 directions over the windows of the pages.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p round-trips
cd round-trips
LAMPS=${ROUND_TRIPS:-desk_lamp led_panel parabolic torch}

# directions SLAB: 1000 unit vectors, out of its pages in turn; Halton's points on their windows.
directions() {
  "$BAKESLAB" info --json "$1" | jq -r '.pages[] | [.st_window, .u, .v, .normal] | flatten | map(tostring) | join(" ")' |
    awk '
      function halton(n, base,   f, x) { for (f = 1; n > 0; n = int(n/base)) { f /= base; x += f*(n%base) } return x }
      { for (k = 1; k <= 13; ++k) page[NR, k] = $k }
      END { for (n = 1; n <= 1000; ++n) {
        p = n%NR + 1
        s = page[p, 1] + (page[p, 2] - page[p, 1])*halton(n, 2)
        t = page[p, 3] + (page[p, 4] - page[p, 3])*halton(n, 3)
        u = v = r = 0
        for (k = 0; k < 3; ++k) { u += page[p, 5 + k]^2; v += page[p, 8 + k]^2 }
        for (k = 0; k < 3; ++k) { d[k] = page[p, 11 + k] + s*page[p, 5 + k]/sqrt(u) + t*page[p, 8 + k]/sqrt(v); r += d[k]^2 }
        printf "%.12g %.12g %.12g\n", d[0]/sqrt(r), d[1]/sqrt(r), d[2]/sqrt(r) } }'
}

# intensities SLAB METRES DIRECTIONS: luminous, for a lamp unit of so many metres
intensities() {
  awk '{ print 1e6*$1, 1e6*$2, 1e6*$3, -$1, -$2, -$3 }' "$3" |
    "$RENDERSLAB" irradiance --light "$1 scale=$2" --tolerance 1e-4 |
    awk '{ printf "%.9g\n", 1e12*(0.2126*$1 + 0.7152*$2 + 0.0722*$3) }'
}

# lumens SLAB: times 179 where that is W
lumens() {
  "$BAKESLAB" info --json "$1" | jq '[.pages[]
    | (if .radiance_unit == "W/(sr m2)" then 179 else 1 end)*(.flux | 0.2126*.[0] + 0.7152*.[1] + 0.0722*.[2])] | add'
}

metres() { "$BAKESLAB" info --json "$1" | jq '.pages[0].metres_per_unit // 1'; }
unit() { "$BAKESLAB" info --json "$1" | jq 'if .pages[0].radiance_unit == "W/(sr m2)" then 179 else 1 end'; }

heading 'slab -> .ies -> slab: of 1000 directions, in % of the largest; flux in %'
for lamp in $LAMPS; do
  slab=$BUILD/round-trips/$lamp.tif
  [ -e "$slab" ] || spend "$lamp-bake" "$BAKESLAB" bake "$root/lamps/$lamp.pov" -o "$slab" -q --yes
  spend "$lamp-export" "$BAKESLAB" export "$slab" -o "$lamp.ies"
  spend "$lamp-import" "$BAKESLAB" import "$lamp.ies" -o "$lamp-ies.tif"
  directions "$slab" >"$lamp.directions"
  paste <(intensities "$slab" "$(metres "$slab")" "$lamp.directions") <(intensities "$lamp-ies.tif" 1 "$lamp.directions") |
    awk -v unit="$(unit "$slab")" '{ a = unit*$1; if (a > top) top = a; print sqrt((a - $2)^2), top }' |
    sort -g | awk '{ off[NR] = $1; if ($2 > top) top = $2 }
      END { for (n = 1; n <= NR; ++n) over += off[n] > top/100
        printf "%.2f %.2f %.1f\n", 100*off[int(0.95*NR)]/top, 100*off[NR]/top, 100*over/NR }' >"$lamp.off"
  read -r part most over <"$lamp.off"
  row "$lamp: 95 % within" "$part" '<= 1' "$(holds "$part <= 1")"
  row "$lamp: all within; by more than 1 %, % of them" "$most $over" '<= 1' "$(holds "$most <= 1")"
  flux=$(calc %.4f "100*($(lumens "$lamp-ies.tif")/$(lumens "$slab") - 1)")
  row "$lamp: flux" "$flux" '+-0.2' "$(holds "($flux)^2 <= 0.04")"
  row "$lamp: CPU s of export, import" "$(cat "$lamp-export.cpu") $(cat "$lamp-import.cpu")"
  row "$lamp: angles, planes; bytes" "$(awk 'NR > 1 && /^1 -1/ { print $4, $5 }' "$lamp.ies") $(stat -c %s "$lamp.ies")"
done

# apertures SLAB: options of import that give its pages, in metres
apertures() {
  "$BAKESLAB" info --json "$1" | jq -r '.pages[] | (.metres_per_unit // 1) as $m
    | def list: map(tostring) | join(",");
    "--center=\(.center | map(.*$m) | list) --u=\(.u | map(.*$m) | list) --v=\(.v | map(.*$m) | list) --normal=\(.normal | list)"'
}

heading 'slab -> rays -> slab, 1,000,000: flux against the slab, relative; error of 8x8 x 32x32 samples, in %'
for lamp in $LAMPS; do
  slab=$BUILD/round-trips/$lamp.tif
  flux=$("$BAKESLAB" info --json "$slab" | jq '[.pages[].flux | 0.2126*.[0] + 0.7152*.[1] + 0.0722*.[2]] | add')
  for kind in tm25ray txt; do
    spend "$lamp-rays" "$BAKESLAB" export "$slab" -o "$lamp.$kind" --rays 1000000
    # shellcheck disable=SC2046 # options without blanks
    "$BAKESLAB" import "$lamp.$kind" -o "$lamp-$kind.exr" -q --uv 8 --st 32 $(apertures "$slab")
    read -r read_in told < <("$BAKESLAB" info --json "$lamp-$kind.exr" |
      jq -r '.pages[0].provenance.import | "\(.flux_in) \(.error)"')
    off=$(calc %.2g "$read_in/$flux - 1")
    row "$lamp.$kind: flux" "$off" '+-1e-6' "$(holds "($off)^2 <= 1e-12")"
    error=$("$TOOLS/cell_error" "$slab" "$lamp-$kind.exr")
    row "$lamp.$kind: error, told" "$(calc %.2f "100*$error") $(calc %.2f "100*$told")" \
      'within 1.5 times' "$(holds "$error <= 1.5*$told")"
    rm "$lamp.$kind"
  done
done
