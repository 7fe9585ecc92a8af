#!/usr/bin/env bash
# What the bake's small bakes decide for each lamp of lamps/, whatever its script says it
# calls for, against a bake of the same rays with every effect, at least as far; then what deciding
# costs beside a bake.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p effects
cd effects

# small NAME LAMP EFFECTS: few rays, since every effect at once costs hours.
small() {
  rm -rf "$1.exr" "$1.exr.partial"
  spend "$1" "$BAKESLAB" bake "$root/lamps/$2.pov" -o "$1.exr" --uv 4 --st 16 --rays 2 --effects "$3"
}
# decided FILE: effects that are on, with their settings.
decided() {
  "$BAKESLAB" info --json "$1" | awk -F'"' '
    / (bounces|photons|lights a side|levels)/ && $4 ~ /^on/ { match($4, /; [0-9]+/); on[$2] = substr($4, RSTART + 2, RLENGTH - 2) }
    END { for (w in on) { printf "%s%s=%s", b, w, on[w]; b = "," } }'
}
# everything LIST FILE: what --effects all stands for, and what was decided to go further;
# caustics only where there is a target for photons, without which a bake that is asked for
# them refuses.
everything() {
  "$BAKESLAB" info --json "$2" >info.json
  echo "interreflection=2,caustics=400000,extended_source=17,deep_trace=30,$1" | tr ',' '\n' |
    awk -F= -v none="$(grep -c '"caustics": "off: flux +0 %, 0 % RMS' info.json)" '
      $1 == "caustics" && none { next }
      $1 != "" && $2 > most[$1] + 0 { most[$1] = $2 }
      END { for (w in most) { printf "%s%s=%s", b, w, most[w]; b = "," } }'
}
# seconds FILE: CPU seconds of the small bakes and of the bake itself.
seconds() { sed -n "s/.*$2 *\([0-9.]*\) CPU s.*/\1/p" "$1"; }
# flux A B: difference of the fluxes of all pages, in %.
flux() {
  "$BAKESLAB" diff --tolerance 1e30 "$1" "$2" | awk '/: flux/ { a += $5; b += $9 } END { printf "%.2f", 100*(a/b - 1) }'
}
# far A B: largest RMSE of a page's light by direction, in % of its peak.
far() {
  local n
  for n in "$1" "$2"; do "$BAKESLAB" convert "$n" -q -o "far-$n" --uv 1; done
  "$BAKESLAB" diff --tolerance 1e30 "far-$1" "far-$2" | awk '/rmse/ { x = substr($5, 2)*100; if (x > most) most = x } END { printf "%.2f", most }'
}

heading 'Effects: decided by small bakes, against all of them (same rays)'
printf '  %-16s %7s %7s %9s %9s %6s  %s\n' lamp 'flux %' 'RMSE %' 'all CPU s' 'CPU s' ratio decided
for lamp in "$root"/lamps/*.pov; do
  name=$(basename "$lamp" .pov)
  small probe "$name" probe
  list=$(decided probe.exr)
  small chosen "$name" "${list:-none}"
  small all "$name" "$(everything "$list" probe.exr)"
  one=$(seconds chosen.log 'rays,') every=$(seconds all.log 'rays,')
  mark=ok
  off=$(flux probe.exr all.exr)
  [ "$(holds "$off < 1 && $off > -1")" = ok ] || mark=MISSED
  printf '  %-16s %7s %7s %9s %9s %6s  %s  %s\n' "$name" "$off" "$(far probe.exr all.exr)" "$every" "$one" \
    "$(calc %.1f "$every/($one + 0.01)")" "${list:-nothing}" "$mark"
done

heading 'CPU seconds of deciding, beside a bake of 16x16 x 64x64 samples of 4 rays with what was decided'
for name in headlight desk_lamp torch; do
  rm -rf whole.exr*
  spend whole "$BAKESLAB" bake "$root/lamps/$name.pov" -o whole.exr --rays 4 --effects probe
  few=$(seconds whole.log took) whole=$(seconds whole.log 'rays,')
  row "$name: $few + $whole" "$(calc %.1f "100*$few/$whole") %"
done
