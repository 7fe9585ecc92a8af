#!/usr/bin/env bash
# demo.sh - the steps of `make demo` that are more than one command.
#   demo.sh timed FILE COMMAND...        runs a command and writes its CPU seconds to FILE
#   demo.sh render SCENE PICTURE OPTION... renders a scene of this folder, with a log and the
#                                        CPU seconds
#   demo.sh compare FOLDER               canned.exr against full.exr and renderslab.exr, as
#                                        text and PNGs
#   demo.sh corner FOLDER                tells what corner-canned.png and corner-full.png took, and
#                                        what that is in noise
set -euo pipefail
here=$(dirname "$0")

# CPU seconds of a command and its children; what it says stays on the terminal.
timed() {
  local file=$1 TIMEFORMAT='%U %S'
  shift
  { time "$@" 2>&3; } 3>&2 2>"$file"
  awk '{ printf "%.1f\n", $1 + $2 }' "$file" >"$file.sum"
  mv "$file.sum" "$file"
}

render() {
  local scene=$1 picture=$2 base=${2%.*}
  shift 2
  if ! timed "$base.seconds" povray "+I$here/$scene.pov" "+O$picture" -D "$@" >"$base.log" 2>&1; then
    rm -f "$picture"
    echo "demo.sh: POV-Ray failed; see $base.log" >&2
    return 1
  fi
}

# Mean of a picture's green channel (demo.pov is grey).
mean() {
  oiiotool "$@" --printstats -o "$scratch" | awk '/Stats Avg/ { print $4 }'
}

# Relative RMS difference of two pictures, after averaging blocks of the given size. Statistics
# are printed with six decimals: a thousandfold difference keeps its digits.
difference() {
  local size="$((320 / $1))x$((160 / $1))"
  local square
  square=$(mean "$2" --resize:filter=box "$size" "$3" --resize:filter=box "$size" --sub --mulc 1000 --dup --mul)
  awk -v square="$square" -v mean="$(mean "$3")" 'BEGIN { printf "%.1f %%", 0.1*sqrt(square)/mean }'
}

compare() {
  local folder=$1 canned=$1/canned.exr full=$1/full.exr block
  scratch=$(mktemp --suffix=.exr)
  trap 'rm -f "$scratch"' EXIT
  for picture in canned renderslab full; do
    oiiotool "$folder/$picture.exr" --mulc 2 --powc 0.4545454 -o "$folder/$picture.png"
  done
  oiiotool "$canned" "$full" --absdiff --mulc 2 --powc 0.4545454 -o "$folder/difference.png"
  awk -v c="$(mean "$canned")" -v f="$(mean "$full")" -v tc="$(cat "$folder/canned.seconds")" \
    -v tf="$(cat "$folder/full.seconds")" -v tb="$(cat "$folder/bake.seconds")" 'BEGIN {
    printf "\n                      canned lamp   whole lamp\n"
    printf "mean of the picture   %11.5f  %11.5f   ratio %.4f\n", c, f, c/f
    printf "CPU seconds           %11.1f  %11.1f   ratio 1 : %.0f\n", tc, tf, tf/tc
    printf "baking took %.1f CPU seconds, once for all scenes\n\n", tb }'
  for block in 1 4 16; do
    printf 'RMS difference, means of %2d x %2d pixels: %s\n' "$block" "$block" \
      "$(difference "$block" "$canned" "$full")"
  done
  cat <<TEXT
Single pixels differ by the noise of the whole lamp's radiosity, which averages out; what
stays in the means of blocks is the slab's own blur (16 x 16 positions on the aperture).

The canned lamp in POV-Ray and in renderslab, which sums over the whole aperture rather than
over 16 x 16 lights: $(difference 1 "$canned" "$folder/renderslab.exr") RMS by pixel; renderslab took $(cat "$folder/renderslab.seconds") CPU seconds.

Look at $folder/canned.png, renderslab.png, full.png and difference.png
TEXT
}

corner() {
  cat <<TEXT

A furnished corner under the canned lamp, $1/corner-canned.png: $(cat "$1/corner-canned.seconds") CPU seconds.
Under the whole lamp, with the blotches that radiosity has at equal time, $1/corner-full.png: $(cat "$1/corner-full.seconds").

on plain pieces of wall                       canned lamp   whole lamp
RMS deviation from smooth light               1 to 4 %      14 to 20 %
their means against the canned lamp's                       27 % off (RMS)
time for walls within 4 %                     1             50 to 140
(measured once, the last line extrapolated: "What a slab costs and saves" in tests/RESULTS.md)
TEXT
}

"$@"
