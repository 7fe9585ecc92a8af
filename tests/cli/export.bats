#!/usr/bin/env bats
# `bakeslab export`: the kinds, folders that appear whole or not at all, and what is refused.
load slab

setup() {
  mkdir "$BATS_TEST_TMPDIR/work" && cd "$BATS_TEST_TMPDIR/work" || return 1
  raw_slab lamp.tif '[2, 2, 3, 2]' 6 4 ', "name": "lamp"' 3f800000 3f000000 3e800000
}

export_it() { "$BAKESLAB" export "$@"; }

@test "a folder holds the lamp, how it is used, an example and its provenance, and nothing else" {
  run -0 export_it lamp.tif -o out --as radiance
  [[ $output == *"lamp.tif: note: page 1: "*"polygons"*"-ds 0.01 -dj 0 -dt 0 -dc 1"* ]]
  [ "$(ls)" = $'lamp.tif\nout' ]
  [ "$(ls out)" = $'README.md\nexample.rad\nlamp.rad\nlamp_1.cal\nlamp_1_b.dat\nlamp_1_g.dat\nlamp_1_r.dat\nprovenance.json' ]
  grep -q -- '-ds 0.01 -dj 0 -dt 0 -dc 1' out/lamp.rad out/README.md
  [ "$(jq -r '.export, .name, .command' out/provenance.json)" = $'radiance\nlamp\nbakeslab export lamp.tif -o out --as radiance' ]
  jq -e '.error[0].irradiance_rms < 0.01 and .pages[0].name == "lamp"' out/provenance.json
  # The same bits again.
  mkdir again
  (cd again && export_it ../lamp.tif -o out --as radiance -q)
  diff -r -x provenance.json -I '^# Made by' out again/out
}

@test "a folder that is there is refused, and replaced as a whole where an export made it" {
  export_it lamp.tif -o out --as radiance -q
  refuses 1 out 'is there' --force -- export_it lamp.tif -o out --as radiance
  touch out/more
  export_it lamp.tif -o out/ --as radiance -q --force --name other
  [ "$(ls out)" = $'README.md\nexample.rad\nother.rad\nother_1.cal\nother_1_b.dat\nother_1_g.dat\nother_1_r.dat\nprovenance.json' ]
  mkdir mine empty
  echo precious >mine/thing
  refuses 1 mine 'was not made by bakeslab export' -- export_it lamp.tif -o mine --as radiance --force
  refuses 1 lamp.tif 'no folder' -- export_it lamp.tif -o lamp.tif --as radiance --force
  ln -s out link
  refuses 1 link 'no folder' -- export_it lamp.tif -o link --as radiance --force
  export_it lamp.tif -o empty --as radiance -q --force
  [ -s empty/lamp.rad ]
  [ "$(cat mine/thing)" = precious ]
  [ "$(ls)" = $'empty\nlamp.tif\nlink\nmine\nout' ]
  # What is refused leaves the old folder as it was.
  raw_slab dark.tif '[1, 1, 1, 1]' 1 1 ', "name": "lamp"' 00000000
  refuses 1 dark.tif 'no light' -- export_it dark.tif -o out --as radiance --force
  [ -s out/other.rad ]
}

# A stand-in for Blender that never ends, and tells when it began: an export half done.
start_export() {
  printf '#!/bin/sh\ntouch "%s"\nexec sleep 60\n' "$PWD/begun" >slow && chmod +x slow
  rm -f begun
  set -m # or jobs ignore SIGINT
  BLENDER=$PWD/slow "$BAKESLAB" export lamp.tif -o out --as cycles --blend -q "$@" 3>&- &
  set +m
  for ((k = 0; k < 500; ++k)); do
    [ ! -e begun ] || return 0
    sleep 0.01
  done
  false
}

# Ends it by a signal, of which it dies.
end_export() {
  local status=0
  kill -"$1" $!
  wait $! || status=$?
  [ "$status" -eq $((128 + $1)) ]
}

@test "an export that is interrupted leaves nothing; what one leaves that is killed, the next removes" {
  local number entries=$'begun\nlamp.tif\nslow'
  for number in 1 2 15; do
    start_export
    compgen -G 'out.unfinished-export.??????/lamp.json'
    end_export $number
    [ "$(ls)" = "$entries" ]
  done
  export_it lamp.tif -o out --as cycles -q --name old
  start_export --force
  end_export 2
  [ "$(ls)" = $'begun\nlamp.tif\nout\nslow' ]
  [ "$(ls out)" = $'README.md\ncanned_lights.py\nexample.py\nold.exr\nold.json\nprovenance.json' ]
  rm -r out
  start_export
  mkdir out.unfinished-export.mine other.unfinished-export.abcdef
  end_export 9
  start_export
  # Of the three folders of that name, those that are nobody's go; one in use stays.
  [ "$(find . -name 'out.unfinished-export.??????' | wc -l)" -eq 1 ]
  export_it lamp.tif -o out --as cycles -q
  [ "$(find . -name 'out.unfinished-export.??????' | wc -l)" -eq 1 ]
  end_export 2
  [ "$(ls)" = $'begun\nlamp.tif\nother.unfinished-export.abcdef\nout\nout.unfinished-export.mine\nslow' ]
}

@test "a lamp that Radiance cannot hold, and a name that is none" {
  raw_slab negative.tif '[1, 1, 2, 1]' 2 1 ', "name": "lamp"' 3f800000 3f800000 3f800000 3f800000 bf800000 3f800000
  refuses 1 negative.tif 'page 1' '(0, 0, 1, 0)' negative -- export_it negative.tif -o out --as radiance
  raw_slab nameless.tif '[1, 1, 1, 1]' 1 1 ', "name": "2 lamps"' 3f800000
  refuses 1 nameless.tif '"2 lamps"' --name -- export_it nameless.tif -o out --as radiance
  local name
  for name in example Provenance; do refuses 1 "\"$name\"" 'a file beside' --name -- export_it lamp.tif -o out --as cycles --name $name; done
  export_it nameless.tif -o out --as radiance -q --name two_lamps --polygons 2x1
  [ "$(grep -c ' polygon ' out/two_lamps.rad)" -eq 2 ]
  # One data file is enough where R = G = B.
  [ "$(ls out/*.dat)" = out/two_lamps_1_r.dat ]
}

@test "the kind is asked for, and options are for their kind" {
  refuses 2 'out: its ending' radiance -- export_it lamp.tif -o out
  refuses 2 --as novel radiance -- export_it lamp.tif -o out --as novel
  refuses 2 -o -- export_it lamp.tif --as radiance
  refuses 2 --polygons -- export_it lamp.tif -o out --as radiance --polygons 0x2
  refuses 2 --tolerance -- export_it lamp.tif -o out --as cycles --tolerance 0.1
  refuses 2 --tolerance -- export_it lamp.tif -o out.tm25ray --tolerance 0.1
  refuses 2 --tolerance -- export_it lamp.tif -o out --as radiance --tolerance 0
  refuses 2 --rays -- export_it lamp.tif -o lamp.ies --rays 10
  refuses 2 --seed -- export_it lamp.tif -o out --as cycles --seed 2
  local name
  for name in '' . .. none/.. /; do refuses 1 "\"$name\"" 'no name' -- export_it lamp.tif -o "$name" --as radiance --force; done
  refuses 1 none/out -- export_it lamp.tif -o none/out --as radiance
  refuses 1 gone.tif -- export_it gone.tif -o out --as radiance
  [ "$(ls)" = lamp.tif ]
}

# The lumens of a slab.
lumens() { "$BAKESLAB" info --json "$1" | jq '.pages[0].flux | 0.2126*.[0] + 0.7152*.[1] + 0.0722*.[2]'; }

@test "photometric files keep the flux, and come back as slabs" {
  raw_slab lamp.tif '[2, 2, 3, 2]' 6 4 ', "name": "lamp", "radiance_unit": "cd/m2"' 44800000 44400000 44000000
  run -0 export_it lamp.tif -o lamp.ies
  [[ $output == *"flux "*" off the slab"*"far field is what is kept"*"four aperture widths"* ]]
  export_it lamp.tif -o lamp.ldt -q
  for file in lamp.ies lamp.ldt; do
    "$BAKESLAB" import $file -o "$file.tif" -q --st 128
    awk -v a="$(lumens lamp.tif)" -v b="$(lumens "$file.tif")" 'BEGIN { exit !(a > 0 && (a - b)^2 < (0.002*a)^2) }' ||
      { echo "$file: $(lumens lamp.tif) $(lumens "$file.tif")"; false; }
  done
  raw_slab dark.tif '[1, 1, 1, 1]' 1 1 '' 00000000
  refuses 1 dark.tif 'no light' -- export_it dark.tif -o dark.ies
  raw_slab negative.tif '[1, 1, 2, 1]' 2 1 '' 40000000 40000000 40000000 bf800000 bf800000 bf800000
  refuses 1 negative.tif 'negative light' -- export_it negative.tif -o negative.ldt
  [ ! -e dark.ies ]
  [ ! -e negative.ldt ]
}

@test "folders for Mitsuba and Blender: what is in them, and what they say" {
  needs python3
  run -0 export_it lamp.tif -o mitsuba --as mitsuba
  [[ $output == *"lamp.tif: note: "*multijitter* ]]
  [ "$(ls mitsuba)" = $'README.md\nexample.xml\nlamp.exr\nlamp.json\nlamp.xml\nprovenance.json\nslab_cells.py\nslab_emitter.py' ]
  run -0 export_it lamp.tif -o blender --as cycles
  [[ $output == *"lamp.tif: note: "*"adaptive sampling"* ]]
  [ "$(ls blender)" = $'README.md\ncanned_lights.py\nexample.py\nlamp.exr\nlamp.json\nprovenance.json' ]
  cmp mitsuba/lamp.json blender/lamp.json
  # The picture holds the samples bit by bit.
  [ "$(oiiotool --hash lamp.tif blender/lamp.exr | grep -oE '[0-9A-F]{40}' | sort -u | wc -l)" -eq 1 ]
  jq -e '.version == 1 and .name == "lamp" and (.pages | length == 1)
    and (.pages[0] | .image == "lamp.exr" and .samples == [2, 2, 3, 2] and .normal == [0, -1, 0])' blender/lamp.json
  python3 -m py_compile mitsuba/slab_emitter.py mitsuba/slab_cells.py blender/canned_lights.py blender/example.py
  # Pages without light are left out; a lamp of none is refused.
  raw_slab dark.tif '[1, 1, 1, 1]' 1 1 ', "name": "lamp"' 00000000
  refuses 1 dark.tif 'no light' -- export_it dark.tif -o dark --as mitsuba
  refuses 1 dark.tif 'no light' -- export_it dark.tif -o dark --as cycles
  refuses 2 --blend -- export_it lamp.tif -o out --as mitsuba --blend
  BLENDER=/none/blender refuses 1 --blend -- export_it lamp.tif -o out --as cycles --blend
  [ ! -e dark ] && [ ! -e out ]
}

@test "Mitsuba's own projectors: what they are, what they lose, and where they cannot" {
  window='-2, 2, -2, 2' raw_slab soft.tif '[4, 4, 4, 4]' 16 16 ', "name": "soft"' 3f800000 3f000000 3e800000
  run -0 export_it soft.tif -o out --as mitsuba --plain --tolerance 0.1
  [[ $output == *"page 1: "*"positions: irradiance 1, 2 and 4 aperture widths away errs "*" %"* ]]
  [[ $output == *"the lamp's face is missing"*"multijitter"*"gain by the scale"* ]]
  views=$(grep -c 'type="projector"' out/soft.xml)
  [ "$views" -ge 16 ]
  [ "$(find out -name 'soft_1_??_??.exr' | wc -l)" -eq "$views" ]
  [ "$(ls out --ignore='*.exr')" = $'README.md\nexample.xml\nprovenance.json\nsoft.xml' ]
  grep -q "value=\"$views\"" out/example.xml
  jq -e '(.error | length) == 3 and .error[2].aperture_widths == 4 and .error[2].irradiance_rms < 0.1' out/provenance.json
  # A narrow window, one far aside, and one that is too wide.
  # shellcheck disable=SC2034 # raw_slab reads it
  for window in '0.1, 0.11, -0.01, 0.01' '-2, 8, -1, 1' '-90, 90, -90, 90'; do
    raw_slab hard.tif '[1, 1, 1, 1]' 1 1 ', "name": "hard"' 3f800000
    refuses 1 hard.tif 'page 1: ' projectors 'leave out --plain' -- export_it hard.tif -o hard --as mitsuba --plain
  done
  refuses 1 soft.tif '"2 lamps"' --name -- export_it soft.tif -o hard --as mitsuba --plain --name '2 lamps'
  refuses 2 --plain mitsuba -- export_it soft.tif -o hard --as cycles --plain
  [ ! -e hard ]
}

@test "ray files: so many rays, the flux exact, the same for the same seed, back within their noise" {
  raw_slab lamp.tif '[2, 2, 3, 2]' 6 4 ', "name": "lamp", "radiance_unit": "cd/m2"' 44800000 44400000 44000000
  run -0 export_it lamp.tif -o lamp.txt --rays 20000
  [[ $output == *"20000 rays of "*" lm"* ]]
  grep -v '^#' lamp.txt | awk -v flux="$(lumens lamp.tif)" '
    { sum += $7; if ($1^2 > 0.01^2*101 || $2 != 0 || $3^2 > 0.01^2*101 || ($4/$5)^2 > 1 || ($6/$5)^2 > 1 || $5 >= 0) out = 1
      d = $4^2 + $5^2 + $6^2 - 1; if (d^2 > 1e-12) out = 1 }
    END { exit !(NR == 20000 && !out && (sum - flux)^2 < (1e-6*flux)^2) }'
  cp lamp.txt first.txt
  export_it lamp.tif -o lamp.txt --rays 20000 -q
  diff -I '^#' first.txt lamp.txt
  export_it lamp.tif -o lamp.txt --rays 20000 -q --seed 2
  run -1 diff -q -I '^#' first.txt lamp.txt
  export_it lamp.tif -o lamp.tm25ray --rays 20000 -q
  [ "$(stat -c %s lamp.tm25ray)" -eq $((288 + 36000 + 28*20000)) ]
  for file in lamp.txt lamp.tm25ray; do
    "$BAKESLAB" import $file -o "$file.tif" -q --center 0,0,0 --u 0.2,0,0 --v 0,0,0.2 --normal 0,-1,0 --uv 2 --st 4
    awk -v a="$(lumens lamp.tif)" -v b="$(lumens "$file.tif")" 'BEGIN { exit !(a > 0 && (a - b)^2 < (0.002*a)^2) }' ||
      { echo "$file: $(lumens lamp.tif) $(lumens "$file.tif")"; false; }
  done
  refuses 2 --rays -- export_it lamp.tif -o lamp.txt --rays 0
}
