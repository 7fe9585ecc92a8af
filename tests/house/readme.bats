#!/usr/bin/env bats
# What README.md tells a newcomer to type exists and works.
load house

@test "the first commands are make demo and make test" {
  [ "$(awk '/^```/ { if (inside) exit; inside = 1; next } inside' "$ROOT/README.md")" = "make demo
make test" ]
}

@test "every make target and command that it names exists" {
  help=$(house_make help)
  for target in $(grep -ohE '`make [a-z]+|^make [a-z]+' "$ROOT/README.md" "$ROOT"/*/README.md | awk '{ print $2 }' | sort -u); do
    grep -q "^make $target " <<<"$help" || { echo "no target $target"; false; }
  done
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    name=${program##*/}
    for command in $(grep -oE "(^|[\`/])$name [a-z]+" "$ROOT/README.md" | awk '{ print $2 }' | sort -u); do
      commands "$program" | grep -qx "$command" || { echo "no command $name $command"; false; }
    done
  done
}

@test "every link leads somewhere" {
  for link in $(grep -oE '\]\([^)#]+' "$ROOT/README.md" | cut -c3- | grep -v '^http'); do
    [ -e "$ROOT/$link" ] || { echo "$link is not there"; false; }
  done
}

@test "a folder's README has a line for each file" {
  cd "$ROOT"
  git ls-files >/dev/null || skip "no git, or no repository"
  for folder in bakeslab include-pov lamps render tests; do
    # Names in backticks are patterns: `cmd_*.c`, `slab.[ch]`.
    mapfile -t patterns < <(grep -oE '`[^` ]+`' "$folder/README.md" | tr -d '`')
    for file in $(git ls-files "$folder"); do
      file=${file#"$folder"/}
      [ "${file##*/}" != README.md ] || continue
      found=
      # shellcheck disable=SC2053
      for p in "${patterns[@]}"; do [[ $file == $p ]] && found=yes; done
      [ -n "$found" ] || { echo "$folder/README.md lacks $file"; false; }
    done
  done
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
