#!/usr/bin/env bash
# How well a slab lights a floor, by how its samples were taken; as in the project's notes
# on sampling, for the paper's lamp. Truth is a ray caster of this lamp (lamp.c).
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"

heading "The paper's lamp, its bulb alone: slabs of 16x16 x 64x64 samples against the lamp itself"
worst=0
for place in '0 0' '2.5 2.5' '6.1 -3.3' '-9 2'; do
  read -r x z <<<"$place"
  view small 200 "$x" "$z"
  read -r error edges < <("$TOOLS/floor" picture small.exr "$x" "$z")
  worst=$(calc %.1e "$error > $worst ? $error : $worst")
done
row 'ray caster against POV-Ray, four pictures: relative RMS' "$worst" '<= 5e-4' "$(holds "$worst <= 5e-4")"
[ "$edges" -le 20 ] || row 'pixels that see another surface' "$edges" '<= 20' MISSED

[ truth.bin -nt "$TOOLS/floor" ] || "$TOOLS/floor" truth truth.bin 16 64 256 >truth.txt
read -r flux _ <truth.txt

declare -A floor flow sample cpu
measure() { # NAME LABEL OPTION...
  local name=$1 label=$2
  shift 2
  [ "$name.exr" -nt "$BAKESLAB" ] || bake "$name" "$@"
  read -r "floor[$name]" "flow[$name]" "sample[$name]" < <("$TOOLS/floor" compare truth.bin "$name.exr")
  cpu[$name]=$(cat "$name.cpu")
  printf '  %-22s %10s %10s %10s %10s %10s %10.1f\n' "$label" "${floor[$name]}" "${sample[$name]}" \
    "$(noise "$name.exr" relative_to_mean)" "${flow[$name]}" "$(noise "$name.exr" flux)" "${cpu[$name]}"
}

printf '\n  %-22s %10s %10s %10s %10s %10s %10s\n' 'in %' floor samples stated flux stated 'CPU s'
measure centre '--centre' --centre
measure uniform4 '--rays 4 --uniform' --rays 4 --uniform
measure uniform16 '--rays 16 --uniform' --rays 16 --uniform
measure uniform64 '--rays 64 --uniform' --rays 64 --uniform
measure default 'default'
measure adaptive16 '--rays 16' --rays 16
measure adaptive64 '--rays 64' --rays 64
read -r limit _ _ < <("$TOOLS/floor" ideal truth.bin)
printf '  %-22s %10s\n' 'exact cell means' "$limit"
cat <<'TEXT'
  floor: RMSE / mean of 64x64 receivers over 160 cm, 60 cm below; samples: RMS error / mean;
  stated: the noise by `bakeslab info`, an upper estimate; exact cell means: what is left to
  the cells' blur (few rays a cell blur a little less than its mean).

TEXT

# The uniform bake's error at another cost, by the power law through 16 and 64 rays.
at_cost() { # ERROR16 ERROR64 COST
  local power="log($2/$1)/log(${cpu[uniform64]}/${cpu[uniform16]})"
  calc %.2f "$1*exp($power*log($3/${cpu[uniform16]}))"
}
for rays in 16 64; do
  for what in floor sample; do
    declare -n error_of=$what
    even=$(at_cost "${error_of[uniform16]}" "${error_of[uniform64]}" "${cpu[adaptive$rays]}")
    ratio=$(calc %.2f "${error_of[adaptive$rays]}/$even")
    same=$(calc %.2f "${error_of[adaptive$rays]}/${error_of[uniform$rays]}")
    row "--rays $rays, error of the ${what}s, adaptive/uniform: same rays, same CPU" "$same, $ratio" '< 1' \
      "$(holds "$ratio < 1")"
  done
done
row "flux of the default bake against $flux W of the lamp, in %" "${flow[default]}" '+-0.5' \
  "$(holds "${flow[default]} <= 0.5 && ${flow[default]} >= -0.5")"
row 'the default bake over --rays 16: error of the floor, CPU' \
  "$(calc %.2f "${floor[default]}/${floor[adaptive16]}"), $(calc %.2f "${cpu[default]}/${cpu[adaptive16]}")"

heading "Sharpened along s and t where that pays (convert --sharpen st): errors before and after, in %"
printf '  %-38s %10s %10s %10s %10s\n' '' floor after flux after
"$TOOLS/floor" ideal truth.bin exact.exr >/dev/null
for name in exact adaptive16 adaptive64; do
  "$BAKESLAB" convert "$name.exr" -o "$name-sharp.exr" --sharpen st
  "$BAKESLAB" convert "$name.exr" -o "$name-positive.exr" --sharpen st --positive
  read -r before flux_before _ < <("$TOOLS/floor" compare truth.bin "$name.exr")
  for kind in sharp positive; do
    read -r after flux_after _ < <("$TOOLS/floor" compare truth.bin "$name-$kind.exr")
    printf '  %-38s %10s %10s %10s %10s\n' "the paper's lamp, $name, $kind" "$before" "$after" "$flux_before" "$flux_after"
  done
done
"$TOOLS/floor" lobe lobe.exr 16 64
"$BAKESLAB" convert lobe.exr -o lobe-sharp.exr --sharpen st
for apertures in 1 3 16; do
  { read -r _ _ _ _ before; read -r _ _ _ _ after; } < <("$TOOLS/floor" own lobe "$apertures" lobe.exr lobe-sharp.exr)
  row "a smooth lamp, $apertures apertures: before, after" "$before, $after" '1/3' "$(holds "$after <= $before/3")"
done

heading "What a slab says of its own error (check --error): stated/true, relative RMS in %"
own() { # LAMP APERTURES NAME...
  local lamp=$1 apertures=$2 said truth
  shift 2
  "$TOOLS/floor" own "$lamp" "$apertures" "${@/%/.exr}" | while read -r said _ _ _ truth; do
    row "$lamp lamp, $1, $apertures apertures" "$said/$truth" 'factor 2' \
      "$(holds "$said <= 2*$truth && $truth <= 2*$said")"
    shift
  done
}
for apertures in 1 3 4 16; do
  own paper "$apertures" exact adaptive16 uniform16 exact-sharp
done
own lobe 3 lobe lobe-sharp
