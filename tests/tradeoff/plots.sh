#!/usr/bin/env bash
# plots.sh - the plots of `make tradeoff`, by gnuplot, from the tables in $BUILD; SVG and PNG.
#   plots.sh scene LAMP SCENE   error against time, every method and POV-Ray's includes
#   plots.sh main               the same for the paper's lamp in the office
#   plots.sh resolution         the floor's error against the slab's samples
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

# What has been measured by METHOD, as an inline block of gnuplot: CPU seconds, error.
block() { # TABLE METHOD NAME CONDITION
  echo "\$$3 << END"
  awk -F'\t' -v method="$2" "/^#/ { next } !n { n = NF; for (k = 1; k <= NF; ++k) at[k] = \$k; next }
    { for (k = 1; k <= NF; ++k) f[at[k]] = \$k }
    f[\"method\"] == method && $4 { if (f[\"level\"] == \"auto\") print \"\"; print f[\"cpu\"], f[\"rms\"] }" "$1"
  echo END
}

scene() { # TABLE OF-POV-RAY TITLE
  local table=$1 pov=$2 method number=0 plots=() style
  local colours=('#d62728' '#1f77b4' '#7f7f7f' '#ff7f0e' '#2ca02c' '#9467bd' '#8c564b' '#17becf' '#555555' '#bcbd22')
  for method in $(awk -F'\t' '/^#/ { next } n++ && !seen[$1]++ { print $1 }' "$table"); do
    block "$table" "$method" "m$number" 'f["sum_rms"] != "-"'
    style="with linespoints lw 2 pt $((number + 4)) ps 1.2 lc rgb '${colours[number % 10]}'"
    plots+=("\$m$number $style title '$method'")
    number=$((number + 1))
  done
  block "$table" auto shadows 'f["sum_rms"] == "-"'
  plots+=("\$shadows with linespoints lw 2 pt 7 ps 1 lc rgb '#e377c2' title 'auto, other shadows'")
  echo '$pov << END'
  grep -v '^[#l]' "$pov"
  echo END
  plots+=("\$pov using 2:3 with linespoints lw 2 dt 2 pt 2 ps 1.5 lc rgb 'black' title 'POV-Ray, include'")
  plots+=("\$pov using 2:3:1 with labels offset 0.8,0.8 left notitle")
  cat <<PLOT
set title "$3"
set logscale xy
set format y '10^{%T}'
set format x '%g'
set grid
set key outside right noenhanced
set xlabel 'CPU seconds'
set ylabel 'relative error of the picture (RMS)'
set offsets graph 0.03, graph 0.06, graph 0.05, graph 0.05
plot $(printf '%s, ' "${plots[@]}" | sed 's/, $//')
PLOT
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

case $1 in
scene) scene "$2-$3.tsv" "$2-$3-pov.tsv" "lamp $2, scene $3" | draw "$2-$3" ;;
main) scene parabolic-office.tsv parabolic-office-pov.tsv "The paper's lamp in an office: what accuracy costs (numbers: lights a side)" | draw main ;;
resolution) resolution | draw resolution ;;
esac
