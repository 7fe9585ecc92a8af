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

# help2man runs PROGRAM --help: give it one for this page. It joins lines into
# paragraphs, so examples get a blank line each.
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/$page" <<END
#!/bin/sh
"$program" $argument "\$@" | sed '/^Examples*:/,/^[^ ]/ s/^  .*/&\n/'
END
chmod +x "$folder/$page"
printf '[see also]\n%s\n' "$see" >"$folder/include"

help2man --no-info --section=1 --name="$summary" --version-string="$version" \
  --source="Canned light sources $version" --manual='Canned light sources' \
  --include="$folder/include" "$folder/$page"
