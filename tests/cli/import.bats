#!/usr/bin/env bats
# bakeslab import: photometric files become slabs that tell their source, and what is refused. Their
# light is tested in tests/unit/test_photometry_slab.c, reading in test_photometry_read.c.

load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  # 100 cd straight down, 0 at the horizon.
  printf 'IESNA:LM-63-2002\n[MANUFAC] Maker\nTILT=NONE\n1 -1 1 4 1 1 2 0.2 0.4 0 1 1 5\n0 30 60 90\n0\n100 80 30 0\n' >lamp.ies
}

declines() { # PIECE... -- ARGUMENT...: refused, and nothing is left
  local pieces=()
  while [ "$1" != -- ]; do pieces+=("$1") && shift; done
  refuses "${pieces[@]}" -- "$BAKESLAB" import "${@:2}" -o s.tif || return 1
  [ ! -e s.tif ]
}

@test "an IES file becomes a slab that tells its source, its assumption and its error" {
  run --separate-stderr "$BAKESLAB" import lamp.ies -o s.tif
  [ "$status" -eq 0 ] && [ -z "$output" ] && [ -z "$stderr" ]
  "$BAKESLAB" check s.tif
  "$BAKESLAB" info --json s.tif >info.json
  jq -e '.pages[0] | .radiance_unit == "cd/m2" and .metres_per_unit == 1 and .samples_are == "cell_means"
    and .name == "lamp" and .normal == [0, -1, 0] and .u == [0.4, 0, 0] and .v == [0, 0, 0.2]' info.json
  jq -e '.pages[0].provenance.import | .source == "lamp.ies" and .kind == "ies" and .error < 0.03
    and (.assumptions | contains("rectangle of 0.4 x 0 x 0.2 m"))
    and (.flux_out - .flux_in | fabs) < 1e-3 * .flux_in' info.json
  # Straight down: 100 cd over 0.08 m2.
  "$BAKESLAB" lookup s.tif <<<'0 0 0  0 -1 0' | awk '{ exit !($1 > 1180 && $1 < 1260 && $1 - $3 < 1) }'
}

@test "the kind is found by content, and the same file gives the same bits" {
  cp lamp.ies lamp.txt
  "$BAKESLAB" import lamp.txt -o a.exr --name lamp
  "$BAKESLAB" import lamp.txt -o b.exr --name lamp
  "$BAKESLAB" diff a.exr b.exr
  "$BAKESLAB" info --json a.exr | jq -e '.pages[0].provenance.import.kind == "ies"'
}

@test "resolution, flux, colour and turn as asked for" {
  "$BAKESLAB" import lamp.ies -o s.exr --uv 3x2 --st 20x10 --lumens 500 --kelvin 3000 --turn 90 --name desk_lamp
  "$BAKESLAB" info --json s.exr | jq -e '.pages[0] | .samples == [3, 2, 20, 10] and .name == "desk_lamp"
    and (.provenance.import | (.flux_out - 500 | fabs) < 0.5 and (.assumptions | contains("turned by 90")))'
  "$BAKESLAB" lookup s.exr <<<'0 0 0  0 -1 0' | awk '{ exit !($1 > $2 && $2 > $3) }'
}

@test "what the user may not expect is told: a long opening, no opening, light along a flat one" {
  sed 's/0.2 0.4 0 1/0.1 1.2 0 1/; s/^0$/0 90/; s/ 4 1 1 2/ 4 2 1 2/; s/^100.*/100 99 99 99 100 50 30 9/' lamp.ies >long.ies
  run --separate-stderr "$BAKESLAB" import long.ies -o s.tif
  [ "$status" -eq 0 ]
  [[ $stderr == *"--turn 90"* && $stderr == *"made thicker"* ]]
  sed 's/0.2 0.4 0 1/0 0 0 1/' lamp.ies >point.ies
  run --separate-stderr "$BAKESLAB" import point.ies -o s.tif
  [[ $stderr == *"no opening"* ]]
  run --separate-stderr "$BAKESLAB" import -q point.ies -o s.tif
  [ -z "$stderr" ]
}

@test "negative intensities stay, where the file can hold them" {
  sed 's/^100.*/100 80 -30 0/' lamp.ies >negative.ies
  refuses 1 "precision float" -- "$BAKESLAB" import -q negative.ies -o s.tif --precision logluv
  "$BAKESLAB" import -q negative.ies -o s.tif
  "$BAKESLAB" lookup s.tif <<<'0 0 0  1.6 -1 0' | awk '{ exit !($1 < 0) }'
}

@test "a TILT file is read from beside the file" {
  sed 's/TILT=NONE/TILT=lamp.tlt/' lamp.ies >tilted.ies
  declines 1 "tilted.ies: line 3" "lamp.tlt" -- tilted.ies
  printf '1\n2\n0 90\n0.5 0.4\n' >lamp.tlt
  "$BAKESLAB" import -q tilted.ies -o s.exr
  "$BAKESLAB" lookup s.exr <<<'0 0 0  0 -1 0' | awk '{ exit !($1 > 600 && $1 < 640) }'
  printf '1\n2\n0 0\n0.5 0.4\n' >lamp.tlt
  rm s.exr
  declines 1 "lamp.tlt" "ascend" -- tilted.ies
}

@test "bad files and options are refused, and nothing is left behind" {
  declines 1 "nothing.ies" -- nothing.ies
  : >empty.ies
  declines 1 "empty.ies: the file is empty" -- empty.ies
  printf 'no light\n' >text.txt
  declines 1 "text.txt: is none of the files" -- text.txt
  head -n 6 lamp.ies >cut.ies
  declines 1 "cut.ies: line 6" "cut off" -- cut.ies
  sed 's/^100.*/0 0 0 0/' lamp.ies >dark.ies
  declines 1 "dark.ies: the lamp has no light" -- dark.ies
  cp lamp.ies second.ies
  declines 1 "import second.ies by itself" -- lamp.ies second.ies
  declines 2 "no file given" --
  declines 2 "--turn" -- lamp.ies --turn 45
  declines 2 "--kelvin" -- lamp.ies --kelvin 10
  refuses 2 "no output given" -- "$BAKESLAB" import lamp.ies
  refuses 1 "lamp.ies" -- "$BAKESLAB" import lamp.ies -o lamp.ies
}
