# render.bash - slabs, scenes and comparisons for the tests of renderslab's pictures.
# shellcheck shell=bash
load ../testing

# letter_slab FILE.tif NAME U V JSON: U x V views of 16 x 16, each a letter F on a dim ground,
# as bright as its number. JSON holds what the header has besides format, name and samples.
letter_slab() {
  local file=$1 name=$2 u=$3 v=$4 more=$5 views=() k
  oiiotool --create 16x16 3 --fill:color=0.1,0.1,0.1 16x16+0+0 \
    --fill:color=4,3,2 2x12+4+2 --fill:color=4,3,2 8x2+4+2 --fill:color=4,3,2 5x2+4+7 \
    -d float -o letter.exr
  for ((k = 1; k <= u * v; ++k)); do views+=(letter.exr --mulc "$k"); done
  oiiotool "${views[@]}" --mosaic "${u}x$v" --evaloff --caption \
    "{\"format\": \"light-slab\", \"version\": 1, \"name\": \"$name\", \"samples\": [$u, $v, 16, 16], $more}" \
    -d float -o "$file"
}

# The slab that most tests use, oblong in all ways, with its include.
letter_lamp() {
  letter_slab letter_f.tif letter_f 4 3 '"center": [0, 0, 0], "u": [0.2, 0, 0], "v": [0, 0, 0.16], "normal": [0, -1, 0], "st_window": [-1, 1, -1.2, 0.9], "st_distance": 0.8'
  "$BAKESLAB" include letter_f.tif -o letter_f.inc
}

# The mean of R, G and B, with commas between them, of what oiiotool's arguments make. Pictures
# have a layer of errors besides.
mean_of() { oiiotool "$@" --ch R,G,B --echo '{TOP.AVGCOLOR}'; }

# relative A B: RMS of the difference over RMS of B, in %.
relative() {
  local rgb=(--ch 'R,G,B')
  mean_of "$1" "${rgb[@]}" "$2" "${rgb[@]}" --sub --dup --mul --echo '{TOP.AVGCOLOR}' \
    "$2" "${rgb[@]}" --dup --mul | paste -sd, |
    awk -F, '{ printf "%.6f", 100*sqrt(($1 + $2 + $3)/($4 + $5 + $6)) }'
}

# correlation A B: Pearson's, of their first channels.
correlation() {
  local red=(--ch R) mean=(--echo '{TOP.AVGCOLOR}')
  oiiotool "$1" "${red[@]}" "${mean[@]}" "$2" "${red[@]}" "${mean[@]}" \
    "$1" "${red[@]}" --dup --mul "${mean[@]}" "$2" "${red[@]}" --dup --mul "${mean[@]}" \
    "$1" "${red[@]}" "$2" "${red[@]}" --mul "${mean[@]}" | paste -sd' ' |
    awk '{ printf "%.6f", ($5 - $1*$2)/sqrt(($3 - $1*$1)*($4 - $2*$2)) }'
}

# below X Y: both are numbers, and X is less. awk takes "-nan" and "" for less than anything.
below() { awk -v x="$1" -v y="$2" 'BEGIN { exit !(x ~ /[0-9]/ && y ~ /[0-9]/ && x + 0 < y + 0) }'; }

# povray_renders SCENE.pov OUT.exr WIDTH HEIGHT: its words go to OUT.exr.log.
povray_renders() {
  povray "+I$1" "+O$2" "+W$3" "+H$4" -A +FE -D >"$2.log" 2>&1 || { tail -n 20 "$2.log"; return 1; }
}

# agree LIMIT NAME MESH OPTION...: renderslab's picture by the sum that POV-Ray's lights are
# is within LIMIT % of POV-Ray's, and by the reference within a limit that REFERENCE sets.
agree() {
  local limit=$1 name=$2 mesh=$3 error size=160x120
  shift 3
  set -- "$@" --camera "${CAMERA:-from=0.3,2,-2.2 at=0,0,0.1 fov=50}" --size $size -q
  "$RENDERSLAB" image "$mesh" "$@" -o "$name.exr" --method views
  "$RENDERSLAB" pov "$mesh" "$@" -o "$name.pov"
  povray_renders "$name.pov" "$name.pov.exr" ${size/x/ }
  error=$(relative "$name.exr" "$name.pov.exr")
  echo "# $name: views $error %"
  below "$error" "$limit" || return 1
  [ -n "${REFERENCE:-}" ] || return 0
  "$RENDERSLAB" image "$mesh" "$@" -o "$name.reference.exr" --method reference --tolerance 1e-3
  error=$(relative "$name.reference.exr" "$name.pov.exr")
  echo "# $name: reference $error %"
  below "$error" "$REFERENCE"
}

# harmless PIECE COMMAND...: refused with one line that says the piece; the folder is as it was at
# the last `remember`.
remember() { before=$(ls); }
harmless() {
  refuses '[12]' "$1" -- "${@:2}" || return 1
  [ "$(ls)" = "$before" ] || { echo "left behind: $(ls)"; return 1; }
}
