#!/usr/bin/env bash
# plots.sh - the plot of `make tradeoff` of the floor's error against the slab's samples, by
# gnuplot, from the table in $BUILD; SVG and PNG.
set -euo pipefail
cd "$BUILD"

# draw NAME: the script on standard input, as NAME.svg and NAME.png.
draw() {
  local name=$1 script
  script=$(cat)
  gnuplot <<<"set terminal svg size 900,560 font 'sans,15' background 'white'
set output '$name.svg'
$script"
  gnuplot <<<"set terminal pngcairo size 900,560 font 'sans,12'
set output '$name.png'
$script"
}

resolution() {
  local st plots=() number=0 colours=('#1f77b4' '#ff7f0e' '#2ca02c') labels=('0,-1' '-1.5,0.7' '1.5,0.5')
  for st in 32 64 128; do
    echo "\$exact$st << END"
    awk -F'\t' -v st=$st '$2 == st { print $3, $4, $1 }' resolution.tsv
    echo END
    echo "\$baked$st << END"
    awk -F'\t' -v st=$st '$2 == st && $5 != "-" { print $3, $5 }' resolution.tsv
    echo END
    plots+=("\$exact$st with linespoints lw 2 pt 7 lc rgb '${colours[number]}' title '$st x $st directions'"
      "\$exact$st using 1:2:(sprintf('%d', \$3)) with labels offset ${labels[number]} tc rgb '${colours[number]}' notitle")
    # gnuplot warns of blocks without points.
    ! awk -F'\t' -v st=$st '$2 == st && $5 != "-" { found = 1 } END { exit !found }' resolution.tsv ||
      plots+=("\$baked$st with points pt 4 ps 1.8 lw 2 lc rgb '${colours[number]}' notitle")
    number=$((number + 1))
  done
  cat <<PLOT
set title "The paper's lamp: a floor 3 apertures away (labels: N of N x N positions; squares: as baked)"
set logscale xy
set format x '10^{%T}'
set ytics (1, 2, 5, 10)
set grid
set key top right
set xlabel 'samples of the slab'
set ylabel 'relative error of the irradiance (RMS), %'
set xrange [3e4:4e7]
set yrange [1:10]
plot $(printf '%s, ' "${plots[@]}" | sed 's/, $//')
PLOT
}

resolution | draw resolution
