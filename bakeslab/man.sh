#!/bin/sh
# man.sh PROGRAM PAGE VERSION - the man page of bakeslab or bakeslab-COMMAND on
# stdout, made by help2man from what --help prints.
set -eu
program=$(realpath "$1") page=$2 version=$3
argument=

# One line on what a command does stands in `bakeslab --help`.
case $page in
bakeslab)
  summary='make, inspect and convert light slabs'
  see='light-slab(5), povray(1)'
  for c in $("$program" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p'); do
    [ "$c" = help ] || see="$see, bakeslab-$c(1)"
  done
  ;;
*)
  argument=${page#bakeslab-}
  summary=$("$program" --help | sed -n "s/^  $argument  *//p")
  see='bakeslab(1), light-slab(5)'
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
