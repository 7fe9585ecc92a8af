#!/usr/bin/env bats
# The shelf: every lamp in lamps/ previews, bakes, gives light through each of its
# slabs, and says of itself what it calls for.
load bake

# calls_for LAMP: its Canned_Needs, or that of the script that it includes.
calls_for() {
  local included
  sed -n 's/^Canned_Needs("\(.*\)").*/\1/p' "$1"
  included=$(sed -n 's/^#include "\(.*\.pov\)".*/\1/p' "$1")
  [ -z "$included" ] || calls_for "$(dirname "$1")/$included"
}

# shelve LAMP: one lamp, cheaply: without radiosity, which +Q8 leaves out, and with
# photons only in the bakes of lamps that call for them. Notes what failed.
shelve() {
  local lamp=$1 name effects=none
  name=$(basename "$lamp" .pov)
  [[ " $(calls_for "$lamp") " != *" caustics "* ]] || effects=caustics
  {
    povray "+I$lamp" "+L$CANNED_INCLUDE" "+L$(dirname "$lamp")" +W16 +H12 +Q8 +WT1 -D -GA +FP8 "+O$name.ppm" &&
      bake "$lamp" -q -j 1 -o "$name.tif" --uv 4x4 --st 8x8 --rays 2 --effects "$effects" &&
      "$BAKESLAB" info "$name.tif" >"$name.info"
  } >"$name.log" 2>&1 || tail -n 5 "$name.log" >"$name.failed"
}

# Once for all tests.
setup_file() {
  load bake
  cd "$BATS_FILE_TMPDIR" || return 1
  export -f bake calls_for shelve
  printf '%s\n' "$CANNED_INCLUDE"/../lamps/*.pov | xargs -P "${TEST_JOBS:-2}" -I LAMP bash -c 'shelve LAMP'
}

setup() {
  cd "$BATS_FILE_TMPDIR" || return 1
  LAMPS=("$CANNED_INCLUDE"/../lamps/*.pov)
}

@test "every lamp previews and bakes" {
  local lamp name
  [ "${#LAMPS[@]}" -ge 10 ]
  for lamp in "${LAMPS[@]}"; do
    name=$(basename "$lamp" .pov)
    echo "$name"
    cat "$name.failed" 2>/dev/null && return 1
    # The preview is no even field; the slab is called after the script.
    [ "$(tail -c 576 "$name.ppm" | od -An -v -tu1 | tr -s ' ' '\n' | sort -u | wc -l)" -gt 5 ]
    grep -q ": $name\$" "$name.info"
  done
}

@test "light leaves through every page" {
  local lamp name
  for lamp in "${LAMPS[@]}"; do
    name=$(basename "$lamp" .pov)
    echo "$name"
    awk '/: page [0-9]+ of/ { pages++ } $1 == "flux" && $2 > 0 && $3 > 0 && $4 > 0 { lit++ }
      END { print lit + 0, "of", pages + 0; exit !pages || lit != pages }' "$name.info"
  done
}

@test "every lamp says what it calls for, in known words, and why" {
  local lamp word
  for lamp in "${LAMPS[@]}"; do
    echo "$lamp"
    [ "$(calls_for "$lamp" | wc -l)" -eq 1 ]
    for word in $(calls_for "$lamp"); do
      [[ " interreflection caustics extended_source deep_trace " == *" $word "* ]]
    done
    grep -q '^// It calls for ' "$lamp"
  done
}

@test "lamps with several pages and with a finite st plane are among them" {
  [ "$(grep -l 'page 2 of' ./*.info | wc -l)" -ge 2 ]
  [ "$(grep -lE '^ *st distance +[0-9]' ./*.info | wc -l)" -ge 2 ]
}
