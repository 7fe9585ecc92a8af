#!/bin/sh
# completion.sh PROGRAM - bash completion of a program's commands, of their options and of what
# these take, made from what --help prints.
set -eu
program=$(realpath "$1")
name=${program##*/}
commands=$("$program" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' | grep -vx help | paste -sd ' ')

# The case of a command: its options, and what the one before the cursor takes, as the help calls
# it: "FILE.png" or "auto|all", or names with what they do in parentheses, of a METHOD. Without
# such an option it is what the command works on.
command_case() {
  "$program" "$1" --help | awk -v command="$1" -v quote="'" '
    function finish(    word, count, k) {
      if (names != "" && takes ~ /^[A-Z]+$/ && about ~ /: [a-z-]+ \([^()]*\),/) {
        sub(/^[^:]*: */, "", about)
        gsub(/ *\([^()]*\),? */, "|", about)
        takes = substr(about, 1, length(about) - 1)
      }
      count = split(names, word, " ")
      for (k = 1; k <= count; ++k) {
        options = options " " word[k] (takes != "" && word[k] ~ /^--/ ? "=" : "")
        if (takes != "") cases = cases "        " word[k] ") takes=" quote takes quote " ;;\n"
      }
      names = takes = about = ""
    }
    NR <= 2 && !works_on { usage = usage " " $0 }
    NR == 2 && match(usage, /\[OPTION\.\.\.\] +[A-Z][^ ]*/) {
      works_on = substr(usage, RSTART + 11, RLENGTH - 11)
      gsub(/ /, "", works_on)
    }
    match($0, /^ +(-., )*-[^ ]+/) {
      finish()
      about = substr($0, RLENGTH + 1)
      count = split(substr($0, 1, RLENGTH), word, /, | +/)
      for (k = 1; k <= count; ++k) {
        at = index(word[k], "=")
        if (at) takes = substr(word[k], at + 1)
        names = names " " (at ? substr(word[k], 1, at - 1) : word[k])
      }
      next
    }
    /^                    / { sub(/^ +/, " "); about = about $0; next }
    /^Examples/ { exit }
    { finish() }
    END {
      finish()
      printf "    %s)\n      options=%s%s%s\n      case $previous in\n", command, quote, substr(options, 2), quote
      printf "%s        *) takes=%s%s%s ;;\n      esac\n      ;;\n", cases, quote, works_on, quote
    }'
}

cat <<END
# bash completion of $name, made from its --help.
_$name() {
  local current=\${COMP_WORDS[COMP_CWORD]} previous=\${COMP_WORDS[COMP_CWORD - 1]} options='' takes=''
  COMPREPLY=()
  # bash takes --option=value apart at the sign, and leaves the quote of a word that has no end.
  if [[ \$previous == = ]]; then previous=\${COMP_WORDS[COMP_CWORD - 2]}; fi
  if [[ \$current == = ]]; then current=; fi
  current=\${current#[\\'\\"]}
  case \$COMP_CWORD:\${COMP_WORDS[1]} in
    1:*) takes='$(echo "$commands" | tr ' ' '|')|help|--help|--version' ;;
    2:help) takes='$(echo "$commands" | tr ' ' '|')' ;;
  esac
  case \${takes:+no}:\${COMP_WORDS[1]} in
    no:*) ;;
END
for command in $commands; do
  command_case "$command" | sed '1s/^ */    :/'
done
cat <<'END'
  esac
  # Kinds of files, as the help calls them.
  local endings file
  case $current:$takes in
    -*:*) takes=${options// /|} endings= ;;
    *:SLAB* | *:LIGHT | *:A | *:B) endings='tif|tiff|exr' ;;
    *:MESH) endings='obj|gltf|glb|ply' ;;
    *:FILE | *:IMAGE | *:OUT) endings='*' ;;
    *.[a-z]*) endings=${takes#*.} ;;
    *) endings= ;;
  esac
  if [[ ! $endings ]]; then
    # Words, but no kinds of words.
    mapfile -t COMPREPLY < <(compgen -W "${takes//|/ }" -X '*[A-Z]*' -- "$current")
    if [[ ${COMPREPLY[0]-} == *= ]]; then compopt -o nospace 2>/dev/null; fi
    return
  fi
  compopt -o filenames 2>/dev/null
  while read -r file; do
    if [[ -d $file || $endings == '*' || ${file##*.} =~ ^($endings)$ ]]; then COMPREPLY+=("$file"); fi
  done < <(compgen -f -- "$current")
}
END
echo "complete -F _$name $name"
