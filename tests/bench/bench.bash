# bench.bash - what the benchmarks share: timing, rows of a table, bakes of the paper's
# lamp. Sourced; everything is written below $BUILD.
# shellcheck shell=bash
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
cd "$BUILD" || exit

# spend NAME COMMAND...: runs it with its words in NAME.log; leaves NAME.cpu, NAME.wall in
# seconds and NAME.others, the part of the machine that others used meanwhile, in %.
spend() {
  local name=$1 before after TIMEFORMAT='%U %S %R'
  shift
  before=$(busy)
  if ! { time "$@" >"$name.log" 2>&1 </dev/null; } 2>"$name.time"; then
    tail -n 5 "$name.log" >&2
    return 1
  fi
  after=$(busy)
  awk '{ printf "%.2f\n", $1 + $2 }' "$name.time" >"$name.cpu"
  awk '{ print $3 }' "$name.time" >"$name.wall"
  awk -v busy="$((after - before))" -v hz="$(getconf CLK_TCK)" -v cpu="$(cat "$name.cpu")" \
    -v cores="$(nproc)" '{ o = 100*(busy/hz - cpu)/($3*cores); printf "%.0f\n", (o > 0 ? o : 0) }' \
    "$name.time" >"$name.others"
}

# Clock ticks that all processors spent so far.
busy() { awk '/^cpu / { print $2 + $3 + $4 + $7 + $8 }' /proc/stat; }

# picture NAME SCENE SIZE OPTION...: POV-Ray on one thread.
picture() {
  local name=$1 scene=$2 size=$3
  shift 3
  spend "$name" povray "+I$scene" "+O$name.exr" +FE -A +WT1 "+W$size" "+H$size" -D \
    "+L$CANNED_INCLUDE" "+L$root/lamps" "$@"
}

# view NAME SIZE X Z: the paper's lamp, its bulb alone, seen from (X, 0, Z) over the window.
view() {
  cat >view.pov <<'POV'
#declare Canned_Bake_Effects = "";
#include "parabolic.pov"
camera { perspective location <X, 0, Z> direction y right 3*x up 3*z }
POV
  picture "$1" view.pov "$2" "Declare=X=$3" "Declare=Z=$4"
}

# bake NAME OPTION...: 16x16 x 64x64 samples of the paper's lamp, its bulb alone.
bake() {
  local name=$1
  shift
  rm -rf "$name.exr" "$name.exr.partial"
  spend "$name" "$BAKESLAB" bake "$root/lamps/parabolic.pov" -o "$name.exr" --uv 16x16 --st 64x64 \
    --effects none --window declared --quiet "$@"
}

# A number of "noise" of a slab's provenance, in %; "-" where it is not known.
noise() {
  "$BAKESLAB" info "$1" | awk -v key="\"$2\":" '
    $1 == "noise" { for (n = 2; n < NF; ++n) if (index($n, key)) { printf "%.2f", 100*$(n + 1); found = 1 } }
    END { if (!found) printf "-" }'
}

heading() { printf '\n%s\n' "$1"; }
# row WHAT MEASURED TARGET [MARK]
row() { printf '  %-60s %18s  %-8s %s\n' "$1" "$2" "${3-}" "${4-}" | sed 's/ *$//'; }
# holds EXPRESSION: ok or MISSED. (To awk "nan" and "inf" are variables that hold 0.)
holds() {
  if [[ $1 =~ nan|inf ]]; then echo MISSED; else awk "BEGIN { print ($1) ? \"ok\" : \"MISSED\" }"; fi
}
# calc FORMAT EXPRESSION
calc() {
  if [[ $2 =~ nan|inf ]]; then echo nan; else awk "BEGIN { printf \"$1\", ($2) }"; fi
}
# spread NUMBER...: median (lowest..highest)
spread() {
  printf '%s\n' "$@" | sort -g | awk '{ x[NR] = $1 }
    END { printf "%.2f", x[int((NR + 1)/2)]; if (NR > 1) printf " (%.2f..%.2f)", x[1], x[NR] }'
}
