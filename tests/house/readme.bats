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
  for target in $(pages | xargs grep -ohE '`make [a-z]+|^make [a-z]+' | awk '{ print $2 }' | sort -u); do
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

@test "the lamp in it renders by itself and bakes, and its scene renders" {
  cd "$BATS_TEST_TMPDIR"
  sed -n '/^```pov$/,/^```$/p' "$ROOT/README.md" | grep -v '^```' >desk_lamp.pov
  povray +L"$CANNED_INCLUDE" +Idesk_lamp.pov +Opreview.png +W32 +H24 -D -A -GA 2>preview.log
  [ -s preview.png ]
  "$BAKESLAB" bake desk_lamp.pov -o desk_lamp.tif --uv 2x2 --st 8x8 --rays 1
  "$BAKESLAB" check desk_lamp.tif
  "$BAKESLAB" include desk_lamp.tif -o desk_lamp.inc
  sed -n '/^#include "desk_lamp.inc"/,/^```$/p' "$ROOT/README.md" | grep -v '^```' >scene.tail
  { echo '#version 3.7;'; cat scene.tail; } >scene.pov
  povray +Iscene.pov +Oscene.png +W32 +H24 -D -A -GA 2>scene.log
  [ -s scene.png ]
}

@test "the version is the same everywhere" {
  version=$("$BAKESLAB" --version | awk '{ print $2 }')
  [[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]]
  [ "$("$RENDERSLAB" --version)" = "renderslab $version" ]
  grep -qx "version: $version" "$ROOT/CITATION.cff"
}
