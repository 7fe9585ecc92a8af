#!/usr/bin/env bash
# rooms.sh - holds the order of the rooms: no include that rooms.txt does not allow, no circle
# of includes between files (x.c and x.h are one, x.cc and x.hh too) or between folders. Quiet when clean.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
shopt -s globstar nullglob

# A line an include: the file, and the header that it names, from the repository's root.
includes() {
  local file header
  grep -Ho '^#include "[^"]*"' {bakeslab,render}/**/*.{c,h,cc,hh} | tr -d '"' |
    while IFS=' ' read -r file header; do
      file=${file%%:*}
      for top in "${file%%/*}" bakeslab; do
        [ -e "$top/$header" ] && { echo "$file $top/$header"; break; }
      done || { echo "$file: no room has $header" >&2; exit 1; }
    done
}

forbidden() { # of the includes on stdin, those that the table does not allow
  awk 'function room(path) { sub("/[^/]*$", "", path); return path }
    FNR == NR { top = $1; sub("/.*", "", top); for (n = 2; n <= NF; ++n) may[$1, top "/" $n] = 1; next }
    { from = room($1); to = room($2)
      shared = from ~ /^render/ && to ~ /^bakeslab\/(base|cli|slab|file)$/
      if (from != to && !shared && !((from, to) in may)) { print $1 " may not include " $2; bad = 1 } }
    END { exit bad }' <(grep -v "^#" "$here/rooms.txt") -
}

circle() { # of the pairs on stdin
  ! awk '$1 != $2' | tsort 2>&1 >/dev/null | sed 's/^tsort: -: input contains a loop:/circle:/; s/^tsort: //' | grep .
}

all=$(includes)
status=0
forbidden <<<"$all" || status=1
sed -E 's/\.(c|h|cc|hh)\b//g' <<<"$all" | circle || status=1
sed -E 's,/[^/ ]*( |$),\1,g' <<<"$all" | circle || status=1
exit "$status"
