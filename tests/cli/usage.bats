#!/usr/bin/env bats
# What both programs do alike: usage errors are one line, help, versions.

# shellcheck disable=SC2154 # run sets stderr and stderr_lines
load ../testing

@test "usage errors are one line, from argp and from getopt" {
  for arguments in "" "frobnicate" "help frobnicate" "info" "info a b" "info --nonsense a" "info -x a" \
    "info --json=3 a" "lookup a --page" "lookup a --page 0" "check" "diff a" "diff a b c" \
    "convert a -o b.tif --uv 0x3" "include a" "bake" "bake a -o b.tif --shard 5" "bake -x"; do
    # shellcheck disable=SC2086
    run -2 --separate-stderr "$BAKESLAB" $arguments
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
  run -2 bash -c '"$0" info 2>&1 >/dev/full' "$BAKESLAB"
  [ "$output" = "bakeslab info: no slab given" ]
}

@test "renderslab tells its help and version, and knows no other command" {
  run -0 --separate-stderr "$RENDERSLAB" --help
  [[ $output == "Usage: renderslab COMMAND"*"Exit status: 0 done"* ]]
  [ "$("$RENDERSLAB" help)" = "$output" ]
  run -0 --separate-stderr "$RENDERSLAB" --version
  [ "$output" = "$("$BAKESLAB" --version | sed 's/bakeslab/renderslab/')" ]
  for arguments in "" "frobnicate" "info" "help frobnicate"; do
    # shellcheck disable=SC2086
    run -2 --separate-stderr "$RENDERSLAB" $arguments
    [ "${#stderr_lines[@]}" -eq 1 ]
    [[ $stderr == "renderslab: "*"see renderslab --help" ]]
  done
}

@test "-h is short for --help, of programs and commands" {
  for program in "$BAKESLAB" "$RENDERSLAB"; do
    diff <("$program" -h) <("$program" --help)
    for command in $("$program" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' | grep -vx help); do
      diff <("$program" "$command" -h) <("$program" "$command" --help)
    done
  done
}

@test "bakeslab does not load renderslab's libraries" {
  needs ldd
  for library in embree png; do
    run -0 ldd "$BAKESLAB"
    [[ $output != *"lib$library"* ]]
  done
}
