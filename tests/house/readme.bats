#!/usr/bin/env bats
# What README.md tells a newcomer to type exists and works.
load house

@test "the first commands are make demo and make test" {
  [ "$(awk '/^```/ { if (inside) exit; inside = 1; next } inside' "$ROOT/README.md")" = "make demo
make test" ]
}

# All that is written for people, from the root.
pages() { find README.md bakeslab include-pov lamps render tests -name '*.md'; }

@test "every make target and command that is named exists" {
  cd "$ROOT"
  help=$(house_make help)
  for target in $(pages | xargs grep -ohE '`make [a-z][a-z-]*|^make [a-z][a-z-]*' | awk '{ print $2 }' | sort -u); do
    grep -q "^make $target " <<<"$help" || { echo "no target $target"; false; }
  done
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    name=${program##*/}
    for command in $(pages | xargs grep -ohE "(^|[\`/])$name [a-z]+" | awk '{ print $2 }' | sort -u); do
      commands "$program" | grep -qx "$command" || { echo "no command $name $command"; false; }
    done
  done
}

@test "every link leads somewhere" {
  cd "$ROOT"
  for page in $(pages); do
    for link in $(grep -oE '\]\([^)#]+' "$page" | cut -c3- | grep -v '^http'); do
      [ -e "$(dirname "$page")/$link" ] || { echo "$page: $link is not there"; false; }
    done
  done
}

# listed README FILE: a name in backticks, `cmd_*.c` or `slab.[ch]` say, or a link matches it there.
listed() {
  local pattern file=${2#"${1%README.md}"}
  # shellcheck disable=SC2053
  while read -r pattern; do [[ $file != $pattern ]] || return 0; done < <(grep -oE '`[^` ]+`|\]\([^) ]+' "$1" | sed 's/`//g; s/^](//')
  return 1
}

# The files below these folders: all of them where this is no repository. It may be another user's.
committed() { git -c safe.directory='*' ls-files "$@" 2>/dev/null || find "$@" -type f; }

@test "the nearest README has a line for each file" {
  local folder file lacking=0
  cd "$ROOT"
  for file in $(committed bakeslab include-pov lamps render tests | grep -v '/README\.md$'); do
    folder=${file%/*}
    while [ ! -e "$folder/README.md" ]; do folder=${folder%/*}; done
    listed "$folder/README.md" "$file" || { echo "$folder/README.md lacks $file" && lacking=$((lacking + 1)); }
  done
  [ "$lacking" -eq 0 ]
}

# step N: what the tutorial's step tells to type, but `make install` and a coarser bake.
step() {
  sed -n "/^\*\*$1\. /,/^\*\*$(($1 + 1))\. /p" "$ROOT/README.md" | sed -n '/^```$/,/^```$/p' | grep -v '^```' |
    sed "s|/usr/local/share/canned/include-pov|$CANNED_INCLUDE|; s|bakeslab bake .*|& --uv 4 --st 16 --rays 4|; s|^povray .*|& +W160 +H120 -D|"
}

@test "each step of the tutorial, as it is printed; the scene and the mesh are one room" {
  cd "$BATS_TEST_TMPDIR"
  PATH=$(dirname "$BAKESLAB"):$PATH
  sed -n '/^```pov$/,/^```$/p' "$ROOT/README.md" | grep -v '^```' >desk_lamp.pov
  povray +L"$CANNED_INCLUDE" +Idesk_lamp.pov +Opreview.png +W32 +H24 -D -A -GA 2>preview.log
  [ -s preview.png ]
  step 2 >two && bash -e two
  step 3 >three && bash -e three
  step 4 | grep -v '^[#o]' >four && bash -e four 2>povray.log
  # What it says that lights the room is what does.
  [ "$(step 4 | grep -cFxf room.pov)" -eq 2 ]
  step 5 | grep -v '^renderslab view' >five && bash -e five >irradiance
  [ "$(awk '$1 > 0 && $2 > 0 && $3 > 0' irradiance | wc -l)" -eq 1 ]
  [ -s room.png ] && [ -s mesh.exr ] && [ -s mesh.png ]
  # The same picture, but for edges and POV-Ray's sum over lights.
  povray room.pov +Oroom.exr +FE +W160 +H120 -D -A 2>>povray.log
  renderslab image room.obj --light 'desk_lamp.tif at=0,190,20 gain=5' --method views -q --size 160x120 \
    --camera 'from=-60,140,-290 at=0,80,0 fov=50' -o views.exr
  oiiotool room.exr --ch R,G,B views.exr --ch R,G,B --sub --dup --mul --echo '{TOP.AVGCOLOR}' \
    room.exr --ch R,G,B --dup --mul --echo '{TOP.AVGCOLOR}' | paste -sd, |
    awk -F, '{ error = sqrt(($1 + $2 + $3)/($4 + $5 + $6)); print "# " error; exit !($4 > 0 && error < 0.03) }'
}

@test "the version is the same everywhere" {
  version=$("$BAKESLAB" --version | awk '{ print $2 }')
  [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]
  [ "$("$RENDERSLAB" --version)" = "renderslab $version" ]
  grep -qx "version: $version" "$ROOT/CITATION.cff"
}
