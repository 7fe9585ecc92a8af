# tradeoff.bash - the lamps, scenes and clocks of `make tradeoff` and of its rows in `make
# bench`. Sourced; everything is written below $BUILD. RENDERSLAB, BAKESLAB, LAMPS and FLOOR are
# programs.
# shellcheck shell=bash disable=SC2034
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
cd "$BUILD" || exit

# 0.3 to 2, 4 to 30 and 50 to 300 apertures from a lamp of 20 x 20.
declare -A places=([near]='at=0,30,0' [office]='at=0,240,0' [far]='at=0,2000,0')
declare -A cameras=(
  [near]='from=-30,50,-48 at=0,6,0 fov=48'
  [office]='from=-120,430,-330 at=5,40,10 fov=56'
  [far]='from=-900,3600,-2600 at=0,150,0 fov=56')

# Lamps of 16x16 x 64x64 samples as the paper's, and the scenes.
prepare() {
  local scene lamp
  cp "$here/room.mtl" .
  for scene in near office far; do "$LAMPS" "$scene" "$scene.obj"; done
  for lamp in smooth peaks; do "$LAMPS" "$lamp" "$lamp.tif" 16 64; done
}

# plain A.exr B.exr: the picture alone, without its layer of errors.
plain() { oiiotool "$1" --subimage 0 --ch R,G,B -d float -o "$2"; }

# cpu_of FILE COMMAND...: runs it quietly; its CPU seconds go to FILE.
cpu_of() {
  local file=$1 TIMEFORMAT='%U %S'
  shift
  if ! { time "$@" >"$file.log" 2>&1 </dev/null; } 2>"$file.time"; then
    tail -n 5 "$file.log" >&2
    return 1
  fi
  awk '{ printf "%.3f\n", $1 + $2 }' "$file.time" >"$file"
  rm "$file.time" "$file.log"
}

# povray_cpu PICTURE SCENE WxH OPTION...: CPU seconds on one thread, the median of three runs.
povray_cpu() {
  local picture=$1 scene=$2 size=$3
  shift 3
  for _ in 1 2 3; do
    cpu_of "$picture.cpu" povray "+I$scene" "+O$picture" "+W${size%x*}" "+H${size#*x}" +FE -A -D +WT1 "$@"
    cat "$picture.cpu"
  done | sort -g | sed -n 2p
}

# rows TABLE EXPRESSION [CONDITION]: an awk expression of f["COLUMN"], for the rows that meet
# the condition.
rows() {
  awk -F'\t' "/^#/ { next } !n { n = NF; for (k = 1; k <= NF; ++k) at[k] = \$k; next }
    { for (k = 1; k <= NF; ++k) f[at[k]] = \$k } ${3:-1} { print $2 }" "$1"
}
