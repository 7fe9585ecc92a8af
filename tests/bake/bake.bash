# What the bake's command-line tests share: a scratch folder each, a small lamp,
# and what a refusal must look like.
# shellcheck shell=bash
load ../testing

bake_setup() {
  cd "$BATS_TEST_TMPDIR" || return 1
  flat_lamp flat.pov
}

# flat_lamp FILE [TEXT]: a glowing wall behind an aperture, and more text.
flat_lamp() {
  cat >"$1" <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("flat")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
box { <-50, -50, -1.1>, <50, 50, -1> pigment { rgb 1 } finish { emission 0.5 diffuse 0 } }
LAMP
  printf '%s\n' "${2-}" >>"$1"
}

# A lamp whose bake takes 3 batches of a second or so.
slow_lamp() {
  cat >slow.pov <<'LAMP'
#version 3.7;
#include "canned.inc"
#include concat("par", "ts.inc")
Canned_Lamp("slow")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
box { <-50, -50, -2.1>, <50, 50, -2> pigment { checker rgb 1 rgb <0.1, 0.4, 0> } finish { emission Part diffuse 0 } }
LAMP
  echo '#declare Part = 0.5;' >parts.inc
}
# BAKE_EXEC=exec makes a background job's process the program itself.
bake() { ${BAKE_EXEC-} "$BAKESLAB" bake "$@"; }
small() { bake --uv 2 --st 4 --rays 4 "$@"; }
slow() { bake slow.pov --uv 16x16 --st 8x8 --rays 40 --uniform --precision float "$@"; }

# refused STATUS PATTERN OUTPUT COMMAND...: fails with that status and one line (usage
# has a second one) that matches, and leaves neither the output nor its store.
refused() {
  local expected=$1 pattern=$2 output=$3
  shift 3
  run --separate-stderr "$@"
  # shellcheck disable=SC2154 # bats sets them
  {
    echo "status $status; stderr: $stderr"
    [ "$status" -eq "$expected" ]
    [[ ${stderr_lines[0]} == "bakeslab"*": "* ]]
    [ "$expected" -eq 2 ] || [ "${#stderr_lines[@]}" -eq 1 ]
  }
  [[ $stderr =~ $pattern ]]
  if [ -n "$output" ]; then [ ! -f "$output" ] && [ ! -e "$output.partial" ]; fi
}

# same A B: the pages hold the same samples.
same() { "$BAKESLAB" diff --tolerance 0 "$1" "$2"; }

# Batches that are finished in a store.
finished() { find "$1" -mindepth 1 -maxdepth 1 -type d -name '????????????????????????????????' 2>/dev/null | wc -l; }

# Waits until the store of a running bake has a finished batch.
wait_for_batch() {
  local tries=400
  while [ "$(finished "$1")" -eq 0 ]; do
    [ "$((tries -= 1))" -gt 0 ] || return 1
    sleep 0.05
  done
}

# begin_slow OPTION...: a bake of slow.pov that has a batch and runs on, as the process $!.
begin_slow() {
  BAKE_EXEC='exec' slow -o x.tif "$@" >log 2>&1 3>&- &
  wait_for_batch x.tif.partial
}

# no_process_left TRIES: no POV-Ray of this test runs on, 20 tries a second.
no_process_left() {
  local tries=$1
  while [ -n "$(find /proc/[0-9]*/cwd -lname "$PWD/*.partial/*" 2>/dev/null)" ]; do
    [ "$((tries -= 1))" -gt 0 ] || return 1
    sleep 0.05
  done
}
