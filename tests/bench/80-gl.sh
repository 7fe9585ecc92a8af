#!/usr/bin/env bash
# Frames a second by OpenGL, the sum over views alone (figure 3's scene, its receivers given):
# one pass, a pass a view, and with shadow maps of 2048 x 2048 texels. The paper tells about 10
# for 8 x 8 views on a Reality Engine 2 and for 4 x 4 on an O2, of 1998.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p gl
cd gl
mesh=$root/render/scenes/figure3.obj

# frames SLAB WxH [GROUPS]: milliseconds of one pass and of a pass a view; the renderer.
frames() { "$TOOLS/frames" "$1" "$mesh" "${2%x*}" "${2#*x}" ${3+"$3"}; }

per_second() { calc %.3g "1000/$1"; }

table() {
  local size=$1 n one many name shadows groups
  printf '  %-8s %12s %12s %8s %16s %16s\n' views 'one pass' 'a pass each' ratio 'shadows, each' 'shadows, 16'
  for n in 4 8 16 64; do
    [ -e "lamp$n.tif" ] || "$LAMPS" smooth "lamp$n.tif" "$n" "$((n > 16 ? 32 : 64))"
    read -r one many name < <(frames "lamp$n.tif" "$size")
    shadows='' groups=''
    [ "$n" -gt 16 ] || read -r shadows _ < <(frames "lamp$n.tif" "$size" 0)
    [ "$n" -gt 16 ] || read -r groups _ < <(frames "lamp$n.tif" "$size" 4)
    printf '  %-8s %12s %12s %8s %16s %16s\n' "${n}x$n" "$(per_second "$one")" "$(per_second "$many")" \
      "$(calc %.2f "$many/$one")" "${shadows:+$(per_second "$shadows")}" "${groups:+$(per_second "$groups")}"
  done
  printf '  by %s\n' "$name"
}

heading 'OpenGL, frames a second at 640x480'
table 640x480
read -r one _ < <(frames lamp8.tif 640x480)
row '8x8 views unshadowed, frames a second' "$(per_second "$one")" '>= 10' "$(holds "1000/$one >= 10")"
