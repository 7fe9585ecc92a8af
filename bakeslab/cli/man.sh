#!/bin/sh
# man.sh PROGRAM PAGE VERSION - the man page of a program or PROGRAM-COMMAND on
# stdout, made by help2man from what --help prints.
set -eu
program=$(realpath "$1") page=$2 version=$3
name=${program##*/}
argument=

# What the program does is the second line of its --help, and there is one line
# on each command.
case $page in
"$name")
  summary=$("$program" --help | sed -n '2{s/^./\L&/;s/\.$//;p;}')
  see='light-slab(5), povray(1)'
  for p in bakeslab renderslab; do
    [ "$p" = "$name" ] || see="$p(1), $see"
  done
  for c in $("$program" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p'); do
    [ "$c" = help ] || see="$see, $name-$c(1)"
  done
  ;;
*)
  argument=${page#"$name"-}
  summary=$("$program" --help | sed -n "s/^  $argument  *//p")
  see="$name(1), light-slab(5)"
  ;;
esac

# help2man runs PROGRAM --help: give it one for this page. It joins lines into paragraphs, so
# examples, which people paste, go in as they are.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# shellcheck disable=SC2086 # no argument, or one
"$program" $argument --help >"$folder/help"
cat >"$folder/$page" <<END
#!/bin/sh
"$program" $argument "\$@" | sed '/^Examples/,/^\$/d'
END
chmod +x "$folder/$page"
{
  if grep -q '^Examples' "$folder/help"; then
    sed -n 's/^Examples\(, \(.*\)\)*:$/[examples]\n\2\n.nf/p' "$folder/help" | grep .
    sed -n '/^Examples/,/^$/ s/^  //p' "$folder/help" |
      sed "s/[\\\\]/\\\\e/g; s/-/\\\\-/g; s/'/\\\\(aq/g; s/\^/\\\\(ha/g; s/\`/\\\\(ga/g; s/~/\\\\(ti/g; s/^\./\\\\\&./"
    echo .fi
  fi
  printf '[see also]\n%s\n' "$see"
} >"$folder/include"

help2man --no-info --section=1 --name="$summary" --version-string="$version" \
  --source="Canned light sources $version" --manual='Canned light sources' \
  --include="$folder/include" "$folder/$page"
