#!/usr/bin/env bash
# run.sh SIMULATE FOLDER - `make simulate`: FOLDER/table.txt, what it must reach, and
# FOLDER/simulate.png, the plot, by gnuplot.
set -euo pipefail
table=$2/table.txt
"$1" "$(dirname "$0")/times.txt" >"$table"
cat "$table"

# value BAKES WORKERS COLUMN
value() {
  awk -v bakes="# $1: " -v workers="$2" -v column="$3" \
    'index($0, "#") == 1 && !index($0, "# workers") { here = index($0, bakes) == 1 }
     here && $1 == workers { print $column }' "$table"
}
# must WHAT VALUE COMPARED
must() { awk -v what="$1" -v x="$2" "BEGIN { printf \"%-62s %8.3f  %-7s %s\n\", what, x, \"$3\", (x $3) ? \"ok\" : \"MISSED\" }"; }
must "parabolic, 64 equal workers: times as fast as one" "$(value parabolic 64 3)" '>= 50'
must 'shelf of twelve, 1024 equal workers: times as fast as one' "$(value 'shelf of twelve' 1024 3)" '>= 400'
must 'parabolic, 64 workers, a tenth of them dying: longer by' "$(value parabolic 64 8)" '<= 0.15'
must 'shelf of twelve, 1024 workers, a tenth dying: longer by' "$(value 'shelf of twelve' 1024 8)" '<= 0.15'
must 'shelf of twelve, 64 workers, a tenth of them dying: longer by' "$(value 'shelf of twelve' 64 8)" '<= 0.15'
must 'shelf of twelve, 64 workers, a tenth and their machines: by' "$(value 'shelf of twelve' 64 9)" '<= 0.15'

colours=('#1f77b4' '#ff7f0e' '#2ca02c' '#d62728' '#1f77b4' '#d62728')
speed=() idle=()
k=0
while IFS= read -r name; do
  line="with linespoints lw 2 pt 7 ps 0.6 dt $((k > 3 ? 2 : 1)) lc rgb '${colours[k]}'"
  speed+=("'$table' index $k using 1:3 $line title '$name'")
  [ "$k" -gt 3 ] || speed+=("'$table' index $k using 1:6 with points pt 6 ps 1 lc rgb '${colours[k]}' notitle")
  idle+=("'$table' index $k using 1:(100*\$4) $line notitle")
  k=$((k + 1))
done < <(sed -n 's/^# \(.*\): [0-9]* batches.*/\1/p' "$table")
IFS=,
gnuplot <<GNUPLOT
set terminal pngcairo size 1100,480 font 'sans,11'; set output '$2/simulate.png'
set multiplot layout 1,2
set logscale x 2; set xrange [1:1024]; set xlabel 'workers'; set grid lc rgb '#dddddd'
set logscale y 2; set yrange [1:1024]; set ylabel 'times as fast as one worker'; set key top left
plot x with lines lc rgb '#aaaaaa' notitle, ${speed[*]}
unset logscale y; set yrange [0:100]; set ylabel 'idle, % of the workers'' time'
plot ${idle[*]}
GNUPLOT
