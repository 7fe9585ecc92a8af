#!/usr/bin/env bats
# bakeslab import and include of photometric files that are bad, or odd: one line with file and
# line, and nothing left behind.

# shellcheck disable=SC2154 # run sets stderr
load slab

setup() { cd "$BATS_TEST_TMPDIR" || return; }

# ies FILE [VARIABLE=VALUE]...: a small IES file of what the variables say: version, tilt, counts,
# size, factors, rows, planes, candela, rest.
ies() {
  local file=$1 version=IESNA:LM-63-2002 tilt=NONE counts='3 2 1 2' size='.2 .3 0' factors='1 1 20' lumens='1 1000 1'
  local rows='0 45 90' planes='0 90' candela='100 70 10 100 60 0' rest=''
  shift
  while [ $# -gt 0 ]; do
    local "$1"
    shift
  done
  printf '%s\r\n[TEST] none\r\nTILT=%s\r\n%s %s %s\r\n%s\r\n%s\r\n%s\r\n%s\r\n%s' "$version" "$tilt" "$lumens" "$counts" "$size" \
    "$factors" "$rows" "$planes" "$candela" "$rest" >"$file"
}

# ldt FILE [VARIABLE=VALUE]...: a small EULUMDAT file.
ldt() {
  local file=$1 symmetry=1 planes=4 rows=3 sizes='200 100 0 0 0 0' factor=1 sets=1 flux=1000
  local numbers='1 1 1 1 1 1 1 1 1 1 0 90 180 270 0 45 90 100 70 0'
  shift
  while [ $# -gt 0 ]; do
    local "$1"
    shift
  done
  {
    printf '%s\r\n' Canned 1 "$symmetry" "$planes" 90 "$rows" 45 report name number file today 210 110 50
    # shellcheck disable=SC2086 # a line each
    printf '%s\r\n' $sizes 100 80 "$factor" 0 "$sets"
    printf '%s\r\n' 1 LED "$flux" warm 80 10
    printf '%s\r\n' "$numbers"
  } >"$file"
}

# bad FILE PIECE...: both commands refuse it in one line that names the file, and leave nothing.
bad() {
  local file=$1
  shift
  refuses 1 "bakeslab: $file: " "$@" -- "$BAKESLAB" import "$file" -o out.tif
  refuses 1 "bakeslab: $file: " "$@" -- "$BAKESLAB" include "$file" -o out.inc
  [ -z "$(find . -name 'out.*')" ]
}

@test "good ones, to begin with" {
  ies good.ies
  run -0 "$BAKESLAB" import good.ies -o good.tif --uv 2 --st 8
  ldt good.ldt
  run -0 "$BAKESLAB" import good.ldt -o good2.tif --uv 2 --st 8
  # What is in no way a photometric file, but is called so.
  printf 'hello\n' >hello.ies
  bad hello.ies
  : >empty.ies
  bad empty.ies
}

@test "cut off anywhere: refused, or as if a blank at the end were missing" {
  ies whole.ies
  ldt whole.ldt
  for file in whole.ies whole.ldt; do
    size=$(stat -c %s $file)
    for ((length = 1; length < size - 3; length += 7)); do
      head -c $length $file >"cut.${file#*.}"
      refuses 1 "bakeslab: cut.${file#*.}: " -- "$BAKESLAB" import "cut.${file#*.}" -o out.tif
    done
  done
  [ ! -e out.tif ]
}

@test "fewer numbers than promised, or more" {
  ies few.ies candela='100 70 10 100 60'
  bad few.ies 'line 9: ' 'cut off'
  ies many.ies candela='100 70 10 100 60 0 5'
  bad many.ies 'line 8: ' '1 numbers too many'
  ldt few.ldt numbers='1 1 1 1 1 1 1 1 1 1 0 90 180 270 0 45 90 100 70'
  bad few.ldt 'cut off'
  ldt many.ldt numbers='1 1 1 1 1 1 1 1 1 1 0 90 180 270 0 45 90 100 70 0 0'
  bad many.ldt '1 numbers too many'
}

@test "counts of 0, below 0, 1e9, and with a fraction" {
  for count in 0 -1 1e9 1000000000 2.5; do
    ies count.ies counts="$count 2 1 2"
    bad count.ies 'line 4: the number of vertical angles'
    ies count.ies counts="3 $count 1 2"
    bad count.ies 'line 4: the number of horizontal angles'
    ldt count.ldt planes=$count
    bad count.ldt 'line 4: the number of C planes'
    ldt count.ldt rows=$count
    bad count.ldt 'line 6: the number of intensities'
    ldt count.ldt sets=$count
    bad count.ldt 'line 2'
  done
  ies count.ies counts='10000 10000 1 2'
  bad count.ies 'too short for 10000 vertical and 10000 horizontal angles'
  ies type.ies counts='3 2 4 2'
  bad type.ies 'the photometric type'
  ies unit.ies counts='3 2 1 3'
  bad unit.ies 'the unit of length'
}

@test "angles that do not ascend, or do not fit their symmetry" {
  ies angles.ies rows='0 90 45'
  bad angles.ies 'line 6: vertical angles must ascend, but 45 follows 90'
  ies angles.ies rows='0 0 90'
  bad angles.ies 'must ascend, but 0 follows 0'
  ies angles.ies rows='0 45 190'
  bad angles.ies '190 degrees is outside of 0 to 180'
  ies angles.ies planes='0 100'
  bad angles.ies 'line 7: horizontal angles from 0 to 100 fit no symmetry'
  ies angles.ies planes='30 120'
  bad angles.ies 'fit no symmetry'
  ldt angles.ldt numbers='1 1 1 1 1 1 1 1 1 1 0 90 80 270 0 45 90 100 70 0'
  bad angles.ldt 'C angles must ascend, but 80 follows 90'
  ldt angles.ldt symmetry=5
  bad angles.ldt 'line 3: the symmetry (Isym) is 5'
  ldt angles.ldt symmetry=4 planes=6
  bad angles.ldt '6 C planes do not fit the symmetry 4'
}

@test "NaN, infinity and words where numbers should be" {
  for word in nan inf -inf 1e999 x 1..2; do
    ies word.ies candela="100 $word 10 100 60 0"
    bad word.ies 'line 8: ' "$word"
    ies word.ies factors="$word 1 20"
    bad word.ies 'line '
    ldt word.ldt flux=$word
    bad word.ldt 'line '
  done
  ies factor.ies lumens='1 1000 0'
  bad factor.ies 'line 4: the candela multiplier is 0'
  ies factor.ies factors='0 1 20'
  bad factor.ies 'line 5: the ballast factor is 0'
  ldt flux.ldt flux=0
  bad flux.ldt 'have no luminous flux'
}

@test "numbers that no lamp has are refused where they stand" {
  ies most.ies candela='100 1e39 10 100 60 0'
  bad most.ies 'line 8: candela values: 1e+39 is no lamp'
  ies most.ies lumens='1 1000 1e14'
  bad most.ies 'line 4: intensities of 1e+16 cd are no lamp'
  ies least.ies size='1e-30 .3 0'
  bad least.ies "line 4: an opening of 1e-30 x 0.3 x 0 m is no lamp's"
  ies many.ies rest='
1 2 3'
  bad many.ies 'line 10: 3 numbers too many'
}

@test "commas: between numbers, or decimal where those do not add up" {
  ies commas.ies candela='100,70,10, 100 , 60,0' rows='0,45,90'
  run -0 --separate-stderr "$BAKESLAB" import commas.ies -o commas.tif --uv 2 --st 8
  [[ $stderr != *"decimal points"* ]]
  ies point.ies candela='100.5 70 10 100 60 0.5' size='0.2 0.3 0'
  ies decimal.ies candela='100,5 70 10 100 60 0,5' size='0,2 0,3 0'
  "$BAKESLAB" import point.ies -o point.exr --name lamp --uv 2 --st 8 -q
  run -0 --separate-stderr "$BAKESLAB" import decimal.ies -o decimal.exr --name lamp --uv 2 --st 8
  [[ $stderr == *"decimal.ies: note: its commas are read as decimal points"* ]]
  "$BAKESLAB" diff point.exr decimal.exr
  ies cut.ies candela='100,5 70 10 100 60' size='0,2 0,3 0'
  bad cut.ies 'line 9: ' 'cut off'
}

@test "standard input is a file like others" {
  ies lamp.ies
  "$BAKESLAB" import lamp.ies -o file.exr --name lamp --uv 2 --st 8 -q
  # shellcheck disable=SC2002 # a pipe
  cat lamp.ies | "$BAKESLAB" import - -o pipe.exr --name lamp --uv 2 --st 8 -q
  "$BAKESLAB" diff file.exr pipe.exr
  refuses 1 '/dev/stdin: the file is empty' -- "$BAKESLAB" import - -o out.exr
  [ ! -e out.exr ]
}

@test "an opening of type A that the file lays flat faces the light; a tilt of EULUMDAT is told" {
  ies a.ies counts='3 2 3 2' rows='-90 0 90' planes='0 90' candela='0 100 0 0 0 0'
  run -0 --separate-stderr "$BAKESLAB" import a.ies -o a.exr --uv 2 --st 8
  [[ $stderr == *"its opening, flat in the file, faces that way, 0.2 m wide and 0.3 m high"* ]]
  "$BAKESLAB" info --json a.exr | jq -e '(.pages | length) == 1 and .pages[0].normal == [1, 0, 0]'
  ldt tilt.ldt
  awk 'NR == 25 { $0 = "15\r" } { print }' tilt.ldt >tilted.ldt
  run -0 --separate-stderr "$BAKESLAB" import tilted.ldt -o tilted.exr --uv 2 --st 8
  [[ $stderr == *"it was tilted by 15 degrees when it was measured"* ]]
}

@test "angles that leave out a part of the directions are told" {
  ies part.ies rows='10 45 90'
  run -0 --separate-stderr "$BAKESLAB" import part.ies -o part.exr --uv 2 --st 8
  [[ $stderr == *"part.ies: note: its vertical angles go from 10 to 90 degrees: beyond them it is dark"* ]]
  ies whole.ies rows='90 135 180'
  run -0 --separate-stderr "$BAKESLAB" import whole.ies -o whole.exr --uv 2 --st 8
  [[ $stderr != *"beyond them"* ]]
}

@test "a zero byte is no blank, but behind the last line" {
  ies zero.ies candela='100 7~0 10 100 60 0'
  tr '~' '\0' <zero.ies >inside.ies
  bad inside.ies 'line 8: ' '"7?0"'
  ies good.ies
  { cat good.ies && printf '\0\0\0'; } >behind.ies
  run -0 "$BAKESLAB" import behind.ies -o out.tif --uv 2 --st 8
}

@test "negative intensities are kept and told; an include cannot have them" {
  ies negative.ies candela='100 -70 10 100 60 0'
  run -0 --separate-stderr "$BAKESLAB" import negative.ies -o negative.exr --precision float
  # shellcheck disable=SC2154 # run sets it
  [[ $stderr == *negative* ]]
  "$BAKESLAB" info negative.exr | grep -q '^  lowest  *-[0-9]'
  refuses 1 'negative.ies: ' negative -- "$BAKESLAB" include negative.ies -o out.inc
  refuses 1 'negative.ies: ' negative -- "$BAKESLAB" include negative.ies -o out.inc --mode point
  [ -z "$(find . -name 'out.*')" ]
}

@test "TILT: a file that is not there, one that is, and what it says is told" {
  ies tilt.ies tilt=tilt.txt
  bad tilt.ies 'line 3: ' 'tilt.txt' 'put it beside'
  printf '1\n3\n0 45 90\n1 .9 .8\n' >tilt.txt
  run -0 --separate-stderr "$BAKESLAB" import tilt.ies -o tilt.tif --uv 2 --st 8
  [[ $stderr == *tilt* ]]
  mv tilt.txt Tilt.TXT
  run -0 "$BAKESLAB" import tilt.ies -o tilt.tif --uv 2 --st 8
  rm Tilt.TXT
  printf '1\n3\n0 90 45\n1 .9 .8\n' >tilt.txt
  bad tilt.ies 'tilt.txt' 'must ascend'
  ies tilt.ies tilt=
  bad tilt.ies 'line 3: ' 'TILT='
}

@test "openings of no size: a stated small one, and what that means is told; of a mad size: refused" {
  ies point.ies size='0 0 0'
  run -0 --separate-stderr "$BAKESLAB" import point.ies -o point.tif --uv 2 --st 8
  [[ $stderr == *point* || $stderr == *opening* ]]
  ldt point.ldt sizes='0 0 0 0 0 0'
  run -0 --separate-stderr "$BAKESLAB" import point.ldt -o point2.tif --uv 2 --st 8
  ies huge.ies size='1e300 1 0'
  bad huge.ies "no lamp's"
  ies nan.ies size='nan 1 0'
  bad nan.ies 'line 4'
}

@test "files that cannot be read" {
  refuses 1 'none.ies: ' -- "$BAKESLAB" import none.ies -o out.tif
  refuses 1 'none.ies: ' -- "$BAKESLAB" include none.ies -o out.inc
  mkdir folder.ies
  refuses 1 'folder.ies: ' -- "$BAKESLAB" import folder.ies -o out.tif
  refuses 2 'no file given' -- "$BAKESLAB" import -o out.tif
  ies good.ies
  refuses 2 'no output' -- "$BAKESLAB" import good.ies
  ldt other.ldt
  refuses 1 'other.ldt: ' -- "$BAKESLAB" import good.ies other.ldt -o out.tif
  cp good.ies out.tif
  refuses '[12]' 'out.tif' -- "$BAKESLAB" import out.tif -o out.tif
  cmp good.ies out.tif
}

@test "info, check, an include and renderslab --stats tell source, assumption and error" {
  ies lamp.ies
  "$BAKESLAB" import lamp.ies -o lamp.tif --uv 2 --st 16 -q
  told='lamp.ies (ies): each point of the opening .* shines alike there.*; error of its samples [0-9.e-]* %: '
  "$BAKESLAB" info lamp.tif | grep -q "^  imported from $told"
  "$BAKESLAB" check lamp.tif | grep -q "^lamp.tif: imported from $told"
  "$BAKESLAB" include lamp.tif -o slab.inc
  "$BAKESLAB" include lamp.ies -o file.inc
  grep -q "^// Source:  $told" slab.inc
  grep -q "^// Source:  $told" file.inc
  # The error was that of the samples before.
  "$BAKESLAB" convert lamp.tif -o coarse.tif --st 8
  "$BAKESLAB" info coarse.tif | grep '^  imported from lamp.ies (ies): each point' >line
  run ! grep 'error of its samples' line
  echo '0 -1 0  0 1 0' | "$RENDERSLAB" irradiance --light lamp.tif --stats stats.json >/dev/null
  jq -e '.imported[0] | .light == "lamp.tif" and .source == "lamp.ies" and .kind == "ies" and (.assumptions | length) > 20 and .error > 0 and .flux_in > 0' stats.json
}

@test "include of a photometric file: its own table where it is a far field; the cheapest within a tolerance" {
  ies lamp.ies
  run -0 --separate-stderr "$BAKESLAB" include lamp.ies -o point.inc --mode point
  grep -q '^//          The image is the measured table of intensities' point.inc
  grep -qE '^//          [0-9]+ x [0-9]+, which lie on all of its angles' point.inc
  # Of the table, as the import has integrated it.
  "$BAKESLAB" import lamp.ies -o lamp.exr -q
  flux=$("$BAKESLAB" info --json lamp.exr | jq '.pages[0].provenance.import.flux_in')
  awk -v flux="$flux" '/^\/\/   flux at Scale 1/ { exit !($8 > 0.999*flux && $8 < 1.001*flux) }' point.inc
  run -0 --separate-stderr "$BAKESLAB" include lamp.ies -o auto.inc --mode auto --tolerance 0.05 --distance 200
  [[ $stderr == *'with 5 % allowed, '*point* ]]
  cut -c1-20 auto.inc | grep -q '^// Chosen:'
}
