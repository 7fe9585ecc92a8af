#!/usr/bin/env bash
# shelf.sh - the steps of `make lamps` that are more than one command, all in the shelf's folder.
#   shelf.sh flags SCRIPT [FLAGS]       how to bake a lamp: FLAGS, else as its header says
#   shelf.sh try NAME STEP COMMAND...   runs a command; what it says stays in NAME.STEP.log, and in
#                                       NAME.error if it fails
#   shelf.sh preview NAME SCRIPT FOLDER NAME.png: the lamp by itself; FOLDER has canned.inc
#   shelf.sh rooms NAME BAKE RENDER     NAME.near.png, NAME.far.png: what it lights
#   shelf.sh page LAMP...               index.html of these lamps, scripts and files that are
#                                       imported; exit 1 if one was not built
set -euo pipefail
here=$(dirname "$(realpath "$0")")

# The name of a lamp, by its file.
name_of() {
  local name=${1##*/}
  echo "${name%.*}"
}

flags() {
  local flags=${2-}
  [ -n "$flags" ] || flags=$(sed -n 's|^// Bake: bakeslab bake .* -o [^ ]*||p' "$1" | head -n 1)
  # They become words of a shell's command line.
  if [[ ! $flags =~ ^[-A-Za-z0-9_=.,/^\ ]*$ ]]; then
    echo "shelf.sh: $1: its line \"// Bake:\" has more than plain options: $flags" |
      tee "$(name_of "$1").error" >&2
    return 1
  fi
  printf '%s' "$flags"
}

try() {
  local name=$1 log=$1.$2.log status=0
  shift 2
  "$@" 2>"$log" || status=1
  cat "$log" >&2
  [ "$status" -eq 0 ] || cp "$log" "$name.error"
  return "$status"
}

preview() {
  local name=$1 script=$2 folder=$3
  if ! povray "+I$script" "+L$folder" "+L$(dirname "$script")" +W480 +H360 -D +A0.2 +WT1 +FN8 \
    "+O$name.new.png" >"$name.preview.log" 2>&1; then
    rm -f "$name.new.png"
    { echo "$script: POV-Ray cannot show it:" && tail -n 4 "$name.preview.log"; } | tee "$name.error" >&2
    return 1
  fi
  mv "$name.new.png" "$name.png"
}

# Matt and grey; errors of a few per cent are not seen.
rooms() {
  local name=$1 bake=$2 render=$3 which view
  printf 'newmtl matt\nKd 0.8 0.8 0.8\n' >room.mtl
  "$bake" info --json "$name.tif" >"$name.json"
  for which in near far; do
    jq -L "$here" "include \"shelf_room\"; room(\"$which\")" "$name.json" >"$name.$which.json"
    jq -r .obj "$name.$which.json" >"$name.$which.obj"
    mapfile -t view < <(jq -r '.view[]' "$name.$which.json")
    try "$name" image "$render" image "$name.$which.obj" --light "$name.tif" "${view[@]}" --size 480x320 --samples 2 \
      --tolerance 0.03 --threads 1 -q --preview "$name.$which.new.png" -o - >/dev/null
    rm "$name.$which.obj"
  done
  # The last one is what make looks at.
  for which in near far; do mv "$name.$which.new.png" "$name.$which.png"; done
}

# What a lamp is: the first sentences of a script's header, up to those on baking it; the name in a
# photometric file; the first comments of a ray file.
about() {
  case $1 in
    *.ies) sed -n 's/^\[LUMINAIRE\] *//p' "$1" | tr -d '\r' ;;
    *.rays) sed -n '/^#/!q;/^# Licence/q;s/^# *//p' "$1" | tr '\n' ' ' ;;
    *) sed -n '/^\/\//!q;/^\/\/ \(It calls for\|Pages\|Bake\|Use\|Licence\)/q;s|^// *||p' "$1" | tr '\n' ' ' ;;
  esac
}

# What is known of a lamp as JSON; shelf.jq makes a card of it.
facts() {
  local name=$1 script=$2 error='' file files=() inc=$1.inc baked=true log=$1.bake.log
  if [ -e "$name.error" ]; then
    error=$(cat "$name.error")
  elif [ ! -e "$name.far.png" ] || [ ! -e "$inc" ]; then
    error='It was not built.'
  fi
  if [ -n "$error" ]; then
    jq -n --arg name "$name" --arg about "$(about "$script")" --arg error "$error" '{$name, $about, $error}'
    return
  fi
  [[ $script == *.pov ]] || baked=false log=$name.import.log
  for file in "$name".{inc,exr,tif}; do
    [ ! -e "$file" ] || files+=("$file" "$(stat -c %s "$file")")
  done
  jq -n --arg name "$name" --arg about "$(about "$script")" --rawfile log "$log" --argjson baked "$baked" \
    --arg macro "$(grep -m1 -oE '[A-Za-z0-9_]+_Canned\b' "$inc")" \
    --arg housing "$(grep -c '^#macro .*_Canned_Housing()' "$inc" || true)" \
    --slurpfile info "$name.json" --slurpfile near "$name.near.json" --slurpfile far "$name.far.json" \
    '{$name, $about, $baked, $log, $macro, housing: ($housing != "0"), pages: $info[0].pages,
      near: $near[0].distance, far: $far[0].distance,
      files: [$ARGS.positional | _nwise(2) | {name: .[0], bytes: (.[1] | tonumber)}]}' --args "${files[@]}"
}

page() {
  local script broken=0
  for script in "$@"; do facts "$(name_of "$script")" "$script"; done >facts.json
  jq -rs -L "$here" 'include "shelf"; page' facts.json >index.html.new
  mv index.html.new index.html
  for script in "$@"; do
    [ -z "$(jq -r "select(.name == \"$(name_of "$script")\") | .error // empty" facts.json)" ] || {
      echo "make lamps: $script: was not built; see the page" >&2
      broken=1
    }
  done
  return "$broken"
}

"$@"
