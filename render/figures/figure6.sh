#!/usr/bin/env bash
# figure6.sh - the paper's figure 6: include-pov/office.pov under two lamps, by POV-Ray through
# the lamps' includes, and by renderslab from the mesh that the scene writes.
#   figure6.sh mesh FOLDER                    FOLDER/office.obj, .mtl, .camera and .light
#   figure6.sh by_povray OUT.exr OPTION...    POV-Ray's picture, in the folder of the includes
#   figure6.sh by_renderslab LAMP.tif OUT.exr renderslab's, in the folder of the mesh
#   figure6.sh compare FOLDER                 PNGs, and how far the pictures are apart
# RENDERSLAB is the program.
set -euo pipefail
scene=$(cd "$(dirname "$0")/../../include-pov" && pwd)
size=640x480

# POV-Ray writes only below the folder that it works in.
run_povray() { # FOLDER LOG OPTION...
  local folder=$1 log=$2
  shift 2
  if ! (cd "$folder" && povray "+I$scene/office.pov" "+L$scene" -D -A "$@" >"$log" 2>&1); then
    echo "figure6.sh: POV-Ray failed; see $folder/$log" >&2
    return 1
  fi
}

mesh() {
  run_povray "$1" mesh.log +W1 +H1 Declare=Write_Mesh=1 +Omesh.png
  rm "$1/mesh.png"
}

by_povray() {
  local out=$1
  shift
  run_povray "$(dirname "$out")" "$(basename "${out%.exr}").log" "+W${size%x*}" "+H${size#*x}" +FE "+O$(basename "$out")" "$@"
}

by_renderslab() {
  local slab=$1 out=$2 folder
  folder=$(dirname "$out")
  "$RENDERSLAB" image "$folder/office.obj" --light "$slab $(cat "$folder/office.light")" \
    --camera "$(cat "$folder/office.camera")" --size "$size" -o "$out"
}

rgb() { printf '%s --subimage 0 --ch R,G,B ' "$1"; }

# Relative RMS difference of two pictures in %.
difference() {
  # shellcheck disable=SC2046 # words
  oiiotool $(rgb "$1") $(rgb "$2") --sub --dup --mul --echo '{TOP.AVGCOLOR}' \
    $(rgb "$2") --dup --mul --echo '{TOP.AVGCOLOR}' |
    awk -F, '{ sum[NR] = $1 + $2 + $3 } END { printf "%.2f", 100*sqrt(sum[1]/sum[2]) }'
}

compare() {
  local folder=$1 lamp exposure
  for lamp in small large; do
    # The larger lamp gives more light.
    exposure=5
    [ "$lamp" = small ] || exposure=3.6
    for by in povray renderslab; do
      # shellcheck disable=SC2046
      oiiotool $(rgb "$folder/figure6-$lamp-$by.exr") --resize:filter=box 480x360 --mulc $exposure --powc 0.4545454 \
        -o "$folder/figure6-$lamp-$by.png"
    done
    echo "figure 6, $lamp lamp: POV-Ray and renderslab differ by $(difference "$folder/figure6-$lamp-povray.exr" "$folder/figure6-$lamp-renderslab.exr") % (relative RMS)"
  done
}

"$@"
