#!/usr/bin/env bats
# convert --sharpen and check --error.

load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  zero=00000000 one=3f800000
  # one view of 8 x 1: an edge
  black="$zero$zero$zero" white="$one$one$one" means=', "name": "edge", "samples_are": "cell_means"'
  raw_slab edge.tif '[1, 1, 8, 1]' 8 1 "$means" "$black$black$black$black$white$white$white$white"
  # and of 16 x 1: a peak, in quarters
  profile=(0 0 0 0 1 2 3 4 4 3 2 1 0 0 0 0)
  quarters=("$zero" 3e800000 3f000000 3f400000 "$one") samples=
  for k in "${profile[@]}"; do samples+=${quarters[k]}${quarters[k]}${quarters[k]}; done
  raw_slab peak.tif '[1, 1, 16, 1]' 16 1 "$means" "$samples"
}

lookup() { "$BAKESLAB" lookup "$1" <<<"0 0 0 $2 -1 0" | cut -d' ' -f1; }
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { exit !(a - b <= t && b - a <= t) }'; }

@test "--sharpen st: cell means, and no more of anything" {
  "$BAKESLAB" convert peak.tif -o sharp.exr --sharpen st
  for cell in "${!profile[@]}"; do
    middle=$(awk -v k="$cell" 'BEGIN { print -1 + (k + 0.5)/8 }')
    mean=0
    for step in -0.03125 0.03125; do
      radiance=$(lookup sharp.exr "$(awk -v m="$middle" -v s="$step" 'BEGIN { print m + s }')")
      mean=$(awk -v m="$mean" -v r="$radiance" 'BEGIN { printf "%.9g", m + r/2 }')
    done
    near "$mean" "$(awk -v quarters="${profile[cell]}" 'BEGIN { print quarters/4 }')" 1e-6
  done
  run --separate-stderr "$BAKESLAB" info sharp.exr
  [[ $output == *"lowest"*"-0.04416"* ]]
  [[ $output == *"samples are"*"cell_means"* ]]
  [[ $output == *"sharpened"*"st"* ]]
  [[ $output == *"bakeslab convert peak.tif -o sharp.exr --sharpen st"* ]]
}

@test "--sharpen st: never negative in LogLuv, nor with --positive" {
  "$BAKESLAB" convert peak.tif -o sharp.tif --sharpen st
  "$BAKESLAB" convert peak.tif -o - --sharpen st >piped.tif
  "$BAKESLAB" convert peak.tif -o sharp.exr --sharpen st --positive
  for file in sharp.tif piped.tif sharp.exr; do
    lowest=$("$BAKESLAB" info "$file" | awk '$1 == "lowest" { print $2 }')
    near "$lowest" 0 0
    "$BAKESLAB" info "$file" | grep -q 'sharpened .*st, not below zero'
  done
  "$BAKESLAB" include sharp.exr -o out.inc
  "$BAKESLAB" convert peak.tif -o negative.exr --sharpen st
  refuses 1 "negative" -- "$BAKESLAB" include negative.exr -o out2.inc
}

@test "--sharpen st: pages that it would make worse stay as they are, and that is told" {
  # An edge between two cells, whose means are those of points.
  run -0 --separate-stderr "$BAKESLAB" convert edge.tif -o same.exr --sharpen st
  [[ $stderr == "bakeslab: edge.tif: page 1: note: not sharpened: its error would be some "*" times what it is" ]]
  run -0 --separate-stderr "$BAKESLAB" diff --tolerance 0 edge.tif same.exr
  run ! grep -q sharpened <("$BAKESLAB" info same.exr | grep -v command)
  run -0 --separate-stderr "$BAKESLAB" convert peak.tif -o sharp.exr --sharpen st
  [[ $stderr == "bakeslab: peak.tif: page 1: note: sharpened: its error is some 0."*" times what it was" ]]
  raw_slab few.tif '[1, 1, 3, 1]' 3 1 "$means" "$black$white$black"
  run -0 --separate-stderr "$BAKESLAB" convert few.tif -o same.exr --sharpen st
  [[ $stderr == *"page 1: note: not sharpened: too few samples"* ]]
}

@test "--sharpen st: a constant slab keeps its samples, 1-wide axes too" {
  for samples in '[1, 1, 1, 1] 1 1' '[2, 1, 3, 1] 6 1' '[1, 2, 1, 3] 1 6' '[1, 1, 5, 4] 5 4'; do
    raw_slab flat.tif "${samples% * *}" "$(cut -d' ' -f5 <<<"$samples")" "$(cut -d' ' -f6 <<<"$samples")" "$means" 3dcccccd 3f19999a 42c80000
    "$BAKESLAB" convert flat.tif -o sharp.exr --sharpen st
    run -0 --separate-stderr "$BAKESLAB" diff --tolerance 0 flat.tif sharp.exr
  done
}

@test "--sharpen refuses points, and what is sharpened already" {
  raw_slab points.tif '[1, 1, 8, 1]' 8 1 ', "samples_are": "points"' "$one" "$one" "$one"
  refuses 1 "points.tif: page 1: its samples are points" -- "$BAKESLAB" convert points.tif -o x.exr --sharpen st
  "$BAKESLAB" convert peak.tif -o sharp.exr --sharpen st
  refuses 1 "sharp.exr: page 1: is sharpened already" -- "$BAKESLAB" convert sharp.exr -o x.exr --sharpen st
  refuses 1 "sharp.exr: page 1: is sharpened" "--st" -- "$BAKESLAB" convert sharp.exr -o x.exr --st 4x1
  [ ! -e x.exr ]
  # containers and uv are free
  "$BAKESLAB" convert sharp.exr -o copy.tif --precision float --uv 2x1
  refuses 1 "copy.tif: page 1: is sharpened already" -- "$BAKESLAB" convert copy.tif -o x.exr --sharpen st
  # resampling comes first
  "$BAKESLAB" convert peak.tif -o fewer.exr --st 8x1 --sharpen st
  near "$(lookup fewer.exr 0)" 0.97 0.05
  # a slab that does not say how it was sampled is taken at its word
  raw_slab silent.tif '[1, 1, 8, 1]' 8 1 '' "$black$white"
  "$BAKESLAB" convert silent.tif -o silent.exr --sharpen st
}

@test "--sharpen: usage" {
  for arguments in "--sharpen" "--sharpen uv" "--sharpen=" "--positive"; do
    # shellcheck disable=SC2086
    run -2 --separate-stderr "$BAKESLAB" convert edge.tif -o x.exr $arguments
    [ -n "$stderr" ]
  done
  [ ! -e x.exr ]
}

@test "check --error: three distances, what is not known" {
  run -0 --separate-stderr "$BAKESLAB" check --error edge.tif
  [[ $output == *"edge.tif: page 1: error of irradiance at 1 aperture (0.2): at least "*" % (st "*" %, uv unknown, noise unknown)"* ]]
  [[ $output == *"at 4 apertures (0.8)"*"at 16 apertures (3.2)"* ]]
  raw_slab one.tif '[1, 1, 1, 1]' 1 1 '' "$one"
  run -0 --separate-stderr "$BAKESLAB" check --error one.tif
  [[ $output == *"at 16 apertures (3.2): unknown (st unknown, uv unknown, noise unknown)"* ]]
  raw_slab noisy.tif '[4, 4, 4, 4]' 16 16 ', "provenance": {"noise": {"sample": 0.1, "flux": 0.02}}' "$one" "$one" "$one"
  run --separate-stderr "$BAKESLAB" check --error noisy.tif
  [[ $output == *"about 2."*"st 0 %, uv 0 %, noise 2."* ]]
  run --separate-stderr "$BAKESLAB" check noisy.tif
  [[ $output != *"error of"* ]]
  raw_slab dark.tif '[4, 4, 4, 4]' 16 16 '' "$zero"
  run -0 --separate-stderr "$BAKESLAB" check --error dark.tif
  [[ $output == *"about 0 % (st 0 %, uv 0 %, noise unknown)"* ]]
}

@test "info tells the same errors, by their parts; unknown is null, or a word" {
  raw_slab noisy.tif '[4, 4, 4, 4]' 16 16 ', "provenance": {"noise": {"sample": 0.1, "flux": 0.02}}' "$one" "$zero" "$one"
  "$BAKESLAB" convert noisy.tif -o logluv.tif --precision logluv
  for slab in noisy logluv; do
    "$BAKESLAB" info --json $slab.tif >$slab.json
    jq -e '[.pages[0].error[] | (.apertures > 0 and .noise > 0.02) and
      (.all - ([.noise, .resolution, .logluv] | map(. * .) | add | sqrt) | fabs < 1e-9)] == [true, true, true]' $slab.json
    said=$("$BAKESLAB" info $slab.tif | sed -n 's/.* all \([0-9.e+-]* %\) at .*/\1/p')
    [ "$said" = "$("$BAKESLAB" check --error $slab.tif | sed -n 's/.*: about \([0-9.e+-]* %\) (.*/\1/p')" ]
    [ "$(wc -l <<<"$said")" -eq 3 ]
  done
  jq -e '[.pages[0].error[].logluv == 0] | all' noisy.json
  jq -e '[.pages[0].error[].logluv | . > 1e-5 and . < 1e-3] | all' logluv.json
  raw_slab one.tif '[1, 1, 1, 1]' 1 1 '' "$one"
  "$BAKESLAB" info --json one.tif | jq -e '[.pages[0].error[] | .noise, .resolution, .all | . == null] | all'
  run -0 --separate-stderr "$BAKESLAB" info one.tif
  [[ $output == *"error         noise unknown, resolution unknown, LogLuv 0 %, all unknown at 1 aperture (0.2)"* ]]
}

@test "check --error: files that are bad are refused as ever" {
  raw_slab nan.tif '[4, 4, 4, 4]' 16 16 '' 7fc00000
  refuses 1 "nan.tif: page 1: sample (0, 0, 0, 0) is not finite" -- "$BAKESLAB" check --error nan.tif
}
