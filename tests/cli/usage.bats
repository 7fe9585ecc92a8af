#!/usr/bin/env bats
# What both programs do alike: usage errors are one line, help, versions.

# shellcheck disable=SC2154 # run sets stderr and stderr_lines
bats_require_minimum_version 1.5.0
load ../needs

@test "usage errors are one line, from argp and from getopt" {
  for arguments in "" "frobnicate" "help frobnicate" "info" "info a b" "info --nonsense a" "info -x a" \
    "info --json=3 a" "lookup a --page" "lookup a --page 0" "check" "diff a" "diff a b c" \
    "convert a -o b.tif --uv 0x3" "include a" "bake" "bake a -o b.tif --shard 5" "bake -x"; do
    # shellcheck disable=SC2086
    run --separate-stderr "$BAKESLAB" $arguments
    [ "$status" -eq 2 ]
    [ -z "$output" ]
    [ "${#stderr_lines[@]}" -eq 1 ] || { echo "not one line: $stderr"; false; }
    [[ $stderr == bakeslab*": "* && $stderr != *"Try"* ]]
  done
  run --separate-stderr "$BAKESLAB" info --nonsense a
  [ "$stderr" = "bakeslab info: unrecognized option '--nonsense'" ]
  run --separate-stderr "$BAKESLAB" info a $'b\nTry `c'
  [ "$stderr" = 'bakeslab info: b Try `c: one slab at a time' ]
}

@test "a full stdout does not hide a usage error" {
  [ -c /dev/full ] || skip "no /dev/full"
  run bash -c '"$0" info 2>&1 >/dev/full' "$BAKESLAB"
  [ "$status" -eq 2 ]
  [ "$output" = "bakeslab info: no slab given" ]
}

@test "renderslab tells its help and version, and knows no other command" {
  run --separate-stderr "$RENDERSLAB" --help
  [ "$status" -eq 0 ]
  [[ $output == "Usage: renderslab COMMAND"*"Exit status: 0 done"* ]]
  [ "$("$RENDERSLAB" help)" = "$output" ]
  run --separate-stderr "$RENDERSLAB" --version
  [ "$status" -eq 0 ]
  [ "$output" = "$("$BAKESLAB" --version | sed 's/bakeslab/renderslab/')" ]
  for arguments in "" "frobnicate" "info" "help frobnicate"; do
    # shellcheck disable=SC2086
    run --separate-stderr "$RENDERSLAB" $arguments
    [ "$status" -eq 2 ]
    [ "${#stderr_lines[@]}" -eq 1 ]
    [[ $stderr == "renderslab: "*"see renderslab --help" ]]
  done
}

@test "bakeslab does not load renderslab's libraries" {
  needs ldd
  for library in embree assimp png; do
    run ldd "$BAKESLAB"
    [ "$status" -eq 0 ]
    [[ $output != *"lib$library"* ]]
  done
}
