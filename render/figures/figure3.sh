#!/usr/bin/env bash
# figure3.sh - the paper's figure 3, bottom: its scene by a slab of half the resolution in each
# direction, next to the full one.
#   figure3.sh difference A.exr B.exr OUT.png   four times their difference; prints its size
#   figure3.sh factors FULL.tif HALF.tif        CPU seconds of both, and their ratio; the paper's
#                                               was 7.4
# RENDERSLAB is the program.
set -euo pipefail
here=$(dirname "$0")

# Mean of the squares of the pictures that oiiotool's arguments make.
mean_square() {
  oiiotool "$@" --ch R,G,B --dup --mul --echo '{TOP.AVGCOLOR}' | awk -F, '{ print $1 + $2 + $3 }'
}

difference() {
  local rgb=(--ch 'R,G,B') out=$3
  local a=("$1" "${rgb[@]}") b=("$2" "${rgb[@]}")
  oiiotool "${a[@]}" "${b[@]}" --absdiff --mulc 4 --powc 0.4545454 -o "$out"
  awk -v off="$(mean_square "${b[@]}" "${a[@]}" --sub)" -v all="$(mean_square "${a[@]}")" \
    'BEGIN { printf "half the resolution: the picture changes by %.2f %% (relative RMS)\n", 100*sqrt(off/all) }'
}

# seconds SLAB OPTION...: method, level, median CPU seconds of gathering, error of the sum.
seconds() {
  local slab=$1
  shift
  "$RENDERSLAB" tradeoff "$here/../scenes/figure3.obj" --light "$slab at=0,36,0" --size 80x50 --finest 0.1 \
    --camera 'from=-12,34,-100 at=-2,13,0 fov=52' --methods paper,pi,reference,levels,paper-levels --levels 1 -q -o - "$@" |
    awk -F'\t' '!/^(#|method)/ && ($3 == "-" || $3 == "1") { print $1 ($3 == "1" ? "-1" : ""), $5, $13 }'
}

# One run of each slab after the other, for the sums alone and with shadows.
factors() {
  local full=$1 half=$2 what options
  printf '  %-12s %-16s %10s %10s %8s %8s\n' '' method 'full, s' 'half, s' factor 'paper'
  for what in 'sums alone' 'with shadows'; do
    options=()
    [ "$what" = 'with shadows' ] || options=(--no-shadows)
    join <(seconds "$full" "${options[@]}" | sort) <(seconds "$half" "${options[@]}" | sort) |
      awk -v what="$what" '
        $1 == "paper-levels-1" || $1 == "levels-1" { level[$1] = $2; error[$1] = $3; next }
        { full[$1] = $2; printf "  %-12s %-16s %10.3g %10.3g %8.1f %8s\n", what, $1, $2, $4, $2/$4, ($1 == "paper" ? "7.4" : "") }
        END {
          printf "  %-12s %-16s %10.3g %10.3g %8.1f    half uv only, from memory; error %.2g\n", what, "levels 1", full["pi"], level["levels-1"], full["pi"]/level["levels-1"], error["levels-1"]
          printf "  %-12s %-16s %10.3g %10.3g %8.1f    half uv only, on the fly; error %.2g\n", what, "paper-levels 1", full["paper"], level["paper-levels-1"], full["paper"]/level["paper-levels-1"], error["paper-levels-1"]
        }'
  done
}

"$@"
