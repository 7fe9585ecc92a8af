#!/usr/bin/env bash
# growth.sh TABLE PICTURE.png - plots of the errors that `make stability` met, by gnuplot.
set -euo pipefail

colours=('#8c564b' '#9467bd' '#1f77b4' '#2ca02c' '#ff7f0e' '#7f7f7f' '#d62728')
plots=()
for k in "${!colours[@]}"; do
  plots+=("'$1' index axis using 1:(\$$((k + 2)) > 0 ? \$$((k + 2)) : 1/0) with lines lw 2 lc rgb '${colours[k]}' title columnheader($((k + 2)))")
done
mapfile -t names < <(grep -o '^"[^"]*"' "$1" | tr -d '"')
{
  echo "set terminal pngcairo size 1280,640 font 'sans,10'; set output '$2'
set multiplot layout 2,4
set logscale xy; set format '1e%T'; set grid ytics lc rgb '#dddddd'
set yrange [1e-17:10]; set ytics 1e4; set xtics 1e3"
  for axis in "${!names[@]}"; do
    echo "axis = $axis; set title \"${names[axis]}\"; $([ "$axis" = 7 ] && echo 'set key at graph 0.98, 0.46 right samplen 1 maxrows 4' || echo 'unset key')"
    [[ ${names[axis]} == *sample\;* ]] && echo 'set xtics 1e10'
    IFS=,
    echo "plot ${plots[*]}"
    [[ ${names[axis]} == *sample\;* ]] && echo 'set xtics 1e3'
    unset IFS
  done
} | gnuplot
