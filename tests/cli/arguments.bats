#!/usr/bin/env bats
# @FILE on the command line: further arguments from FILE, words as in a shell.

load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  raw_slab a.tif '[1, 1, 1, 1]' 1 1 '' 3f800000
}

# The arguments that `convert` records, after the first.
recorded() {
  "$BAKESLAB" convert -q "$@"
  "$BAKESLAB" info --json out.exr | sed -n 's/^ *"command": "bakeslab convert -q \(.*\)",*$/\1/p'
}

@test "words: blanks, quotes, backslashes, comments, line ends" {
  cp a.tif "it's a \"slab\" #1.tif"
  cat >b <<'END'
# -o nothing.exr
  -o	out.exr   # the rest of the line
\
  --uv=1'x'"1" \
  \
  --st 1\
x1 \
# another
END
  printf '%s\r\n' "\\" "  \\" '"it'"'"'s a \"slab\" #1.tif"' >c
  run -0 recorded @b @c
  quoted="'it'\\\\''s a \\\"slab\\\" #1.tif'" # for a shell, and that for JSON
  [ "$output" = "-o out.exr --uv=1x1 --st 1x1 $quoted" ]
  printf '%s' "'it'\\''s a '\"\\\"slab\\\"\"\\ \\#1.tif -o out.exr" >d
  [ "$(recorded @d)" = "$quoted -o out.exr" ]
}

@test "both programs take their command from a file, and an empty file says nothing" {
  : >nothing
  echo info a.tif >b
  run -0 --separate-stderr "$BAKESLAB" @nothing @b @nothing
  [[ $output == "a.tif: page 1 of 1"* ]]
  echo --version >b
  [ "$("$RENDERSLAB" @b)" = "$("$RENDERSLAB" --version)" ]
}

@test "an empty word and a quoted @ are words" {
  printf '""' >b
  refuses 1 "No such file" -- "$BAKESLAB" info @b
  for word in "'@x.tif'" '"@x.tif"' '\@x.tif' '@"x.tif"' 'info@x'; do
    echo "$word" >b
    case $word in
    @*) refuses 2 "b: line 1: @x.tif: No such file" -- "$BAKESLAB" info @b ;;
    info*) refuses 1 "info@x: No such file" -- "$BAKESLAB" info @b ;;
    *) refuses 1 "bakeslab: @x.tif: No such file" -- "$BAKESLAB" info @b ;;
    esac
  done
}

@test "files name files, 8 deep" {
  echo a.tif >f8
  for k in 1 2 3 4 5 6 7; do echo "@f$((k + 1))" >f$k; done
  run -0 --separate-stderr "$BAKESLAB" info @f1
  echo @f1 >f0
  refuses 2 "f7: line 1: @f8: files name files more than 8 deep" -- "$BAKESLAB" info @f0
  printf '\n\n@self\n' >self
  refuses 2 "self: line 3: @self" -- "$BAKESLAB" info @self
}

@test "what cannot be read is one line with the file and the line" {
  refuses 2 "@none: No such file" -- "$BAKESLAB" info @none
  refuses 2 "@: a file's name must follow" -- "$BAKESLAB" info @
  refuses 2 "@.: Is a directory" -- "$BAKESLAB" info @.
  printf '# one\na.tif @none\n' >b
  refuses 2 "renderslab: b: line 2: @none: No such file or directory" -- "$RENDERSLAB" @b
  printf '\n"a.tif\n\n' >b
  refuses 2 "b: line 2: this double quote is never closed" -- "$BAKESLAB" info @b
  printf "a 'b\n\n' 'c\n\n" >b
  refuses 2 "b: line 3: this single quote is never closed" -- "$BAKESLAB" info @b
  printf '%s' "a.tif \\" >b
  refuses 2 "b: line 1: ends in a backslash" -- "$BAKESLAB" info @b
  printf '@\n' >b
  refuses 2 "b: line 1: @: a file's name must follow" -- "$BAKESLAB" info @b
  printf 'a.tif\n\nx\0y' >b
  refuses 2 "b: line 3: has a zero byte" -- "$BAKESLAB" info @b
  refuses 2 "a.tif: line 1: has a zero byte" -- "$BAKESLAB" info @a.tif
}
