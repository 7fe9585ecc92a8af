#!/usr/bin/env bats
# --light with lumens= and kelvin=: the numbers that receivers get, and what is refused or told.
# shellcheck disable=SC2154 # run sets stderr
load letter

# lux LIGHT: irradiance of one receiver below.
lux() { echo 0.1 0 0.05 0 1 0 | "$RENDERSLAB" irradiance -q --method reference --light "letter_f.tif at=0,1,0 $1"; }
# times A B FACTOR: each number of A is FACTOR times that of B, as wide.
times() { paste -d' ' <(echo "$1") <(echo "$2") | awk -v f="$3" '{ exit !(NF == 6 &&
  ($1/$4/f - 1)^2 < 1e-10 && ($2/$5/f - 1)^2 < 1e-10 && ($3/$6/f - 1)^2 < 1e-10) }'; }

@test "lumens are linear, stay where the lamp is enlarged, and know the scene's unit" {
  one=$(lux lumens=1)
  times "$(lux lumens=800)" "$one" 800
  # As a gain: the lumens of gain=1 are those of info, of unit watts or not.
  lumens=$("$BAKESLAB" info --json letter_f.tif | tr -d ' \n' | sed 's/.*"flux":\[\([^]]*\)\].*/\1/' |
    awk -F, '{ printf "%.9g", 0.2126*$1 + 0.7152*$2 + 0.0722*$3 }')
  times "$(lux "")" "$one" "$lumens"
  times "$(lux 'scale=2 gain=0.25')" "$(lux 'scale=2')" 0.25
  times "$(lux "lumens=$lumens scale=2")" "$(lux scale=2)" 0.25
  times "$(lux "lumens=$lumens metres=10")" "$(lux "")" 0.01
}

@test "kelvin= is a colour of luminance 1, as import's; with lumens= the flux stays" {
  printf '%s\n' 'IESNA:LM-63-2002' 'TILT=NONE' '1 1000 1 2 1 1 2 -.2 0 0' '1 1 20' '0 90' '0' '100 100' >a.ies
  "$BAKESLAB" import a.ies -o grey.exr --uv 2 --st 16 -q
  "$BAKESLAB" import a.ies -o warm.exr --uv 2 --st 16 -q --kelvin 2700
  grey=$(echo 0 0 0 0 1 0 | "$RENDERSLAB" irradiance -q --light 'grey.exr at=0,1,0 kelvin=2700')
  warm=$(echo 0 0 0 0 1 0 | "$RENDERSLAB" irradiance -q --light 'warm.exr at=0,1,0')
  times "$grey" "$warm" 1
  grey=$(echo 0 0 0 0 1 0 | "$RENDERSLAB" irradiance -q --light 'grey.exr at=0,1,0 kelvin=2700 lumens=500')
  warm=$(echo 0 0 0 0 1 0 | "$RENDERSLAB" irradiance -q --light 'warm.exr at=0,1,0 lumens=500')
  times "$grey" "$warm" 1
}

@test "refused: lumens of a black lamp, kelvin that are none, contradictions; told: sizes and units" {
  oiiotool --create 16x16 3 --evaloff --caption '{"format": "light-slab", "version": 1, "samples": [1, 1, 16, 16], "center": [0, 0, 0],
    "u": [1, 0, 0], "v": [0, 0, 1], "normal": [0, -1, 0], "st_window": [-1, 1, -1, 1]}' -d float -o black.tif
  remember
  told() { harmless "$1" "$RENDERSLAB" irradiance --light "$2"; }
  told 'black.tif: it gives no light' 'black.tif lumens=800'
  told 'lumens=0, must be positive' 'letter_f.tif lumens=0'
  told 'kelvin=999, must be from 1000 to 40000' 'letter_f.tif kelvin=999'
  told 'kelvin=40001, must be from' 'letter_f.tif kelvin=40001'
  told 'give one of them' 'letter_f.tif lumens=3 gain=1'
  told 'metres= is the unit for lumens=' 'letter_f.tif metres=1'
  told 'metres=-1, must be positive' 'letter_f.tif lumens=3 metres=-1'
  run -0 --separate-stderr "$RENDERSLAB" irradiance --light 'letter_f.tif lumens=3 scale=0.01' </dev/null
  [[ $stderr == *'note: lumens= with scale=0.01 makes it a lamp of another size'* ]]
  run -0 --separate-stderr "$RENDERSLAB" irradiance --light 'letter_f.tif lumens=3' --light letter_f.tif </dev/null
  [[ $stderr == *'its radiance is in "relative", that of letter_f.tif in "cd/m2"'* ]]
}
