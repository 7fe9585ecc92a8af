#!/usr/bin/env bats
# Bakes that are killed at any moment, and bakes of one output at the same time. KILLS: how
# often (10); KILL_SEED: which moments; KILL_POVRAY=real: with POV-Ray itself, not its stand-in.
load ../bake/bake

setup() {
  cd "$BATS_TEST_TMPDIR" || return 1
  if [ "${KILL_POVRAY-}" = real ]; then
    slow_lamp
    lamp=slow.pov povray=povray size=(--uv 16x16 --st 8x8 --rays 40 --uniform) longest=3
  else
    echo '#include "canned.inc"' >fake.pov
    lamp=fake.pov povray=$BUILD/tests/faults/fake_povray size=(--uv 8 --st 8 --rays 16) longest=0.8
    export FAKE_SECONDS=0.1
  fi
  RANDOM=${KILL_SEED:-1}
}

# Becomes a bake of x.tif, so that a background job's process is it.
a_bake() { exec "$BAKESLAB" bake "$lamp" --povray "$povray" "${size[@]}" --precision float --jobs 2 -q "$@"; }

# A random time up to $1 seconds.
moment() { awk -v most="$1" -v r="$RANDOM" 'BEGIN { printf "%.3f", most * r / 32768 }'; }

# No POV-Ray runs on, and whatever is called like the slab is the slab.
nothing_half_done() {
  no_process_left 40 || return 1
  [ ! -e x.tif ] || same x.tif whole.tif
}

@test "killed at random moments, a bake goes on to the same bits" {
  (a_bake -o whole.tif)
  local killed=0 kills=${KILLS:-10} delay pid status
  for ((k = 0; killed < kills && k < 4 * kills; ++k)); do
    delay=$(moment "$longest")
    (a_bake -o x.tif) >log 2>&1 3>&- &
    pid=$!
    sleep "$delay"
    kill -KILL "$pid" 2>/dev/null || true
    status=0
    wait "$pid" || status=$?
    if [ "$status" -eq 137 ]; then killed=$((killed + 1)); else [ "$status" -eq 0 ]; fi
    nothing_half_done || { echo "kill $k after $delay s"; return 1; }
    if [ -e x.tif ]; then rm x.tif; fi
  done
  (a_bake -o x.tif)
  same x.tif whole.tif
  [ ! -e x.tif.partial ]
  [ "$killed" -eq "$kills" ]
  echo "# $killed kills" >&3
}

@test "POV-Ray killed at random moments: told, and the next bake goes on" {
  (a_bake -o whole.tif)
  local kills=$((${KILLS:-10} / 4 + 1)) pid victim status
  for ((k = 0; k < kills; ++k)); do
    (a_bake -o x.tif) >log 2>&1 3>&- &
    pid=$!
    sleep "$(moment "$longest")"
    victim=$(pgrep -P "$pid" | head -n 1) || true
    if [ -n "$victim" ]; then kill -KILL "$victim" || true; fi
    status=0
    wait "$pid" || status=$?
    cat log
    if [ "$status" -ne 0 ]; then
      [ "$status" -eq 1 ]
      [ "$(wc -l <log)" -eq 1 ]
      [ ! -e x.tif ]
    fi
    nothing_half_done
    rm -f x.tif
  done
  (a_bake -o x.tif)
  same x.tif whole.tif
}

@test "two bakes of one output at once: one slab or the other" {
  local other=("${size[@]}") first second a b wins=0 turns=$((${KILLS:-10} / 2))
  other[1]=3
  (a_bake -o a.tif)
  (size=("${other[@]}") && a_bake -o b.tif)
  for ((k = 0; k < turns; ++k)); do
    (a_bake -o x.tif) >log.a 2>&1 3>&- &
    first=$!
    sleep "$(moment "$longest")"
    (size=("${other[@]}") && a_bake -o x.tif) >log.b 2>&1 3>&- &
    second=$!
    a=0 b=0
    wait "$first" || a=$?
    wait "$second" || b=$?
    cat log.a log.b
    [ "$a" -eq 0 ] || [[ $(cat log.a) == *"another bake of this output is at work"* ]]
    [ "$b" -eq 0 ] || [[ $(cat log.b) == *"another bake of this output is at work"* ]]
    [ "$a" -eq 0 ] || [ "$b" -eq 0 ]
    same x.tif a.tif || same x.tif b.tif
    [ ! -e x.tif.partial ]
    wins=$((wins + (a == 0) + (b == 0)))
    rm x.tif
  done
  echo "# $turns pairs, $wins bakes done" >&3
}

@test "other writers of one output at once: one file or the other" {
  (a_bake -o a.tif)
  "$BAKESLAB" convert a.tif -o b.tif --uv 2 --precision float
  for _ in 1 2 3 4 5 6 7 8; do
    "$BAKESLAB" convert a.tif -o x.tif --precision float &
    "$BAKESLAB" convert a.tif -o x.tif --uv 2 --precision float &
    wait
    same x.tif a.tif || same x.tif b.tif
  done
  [ "$(find . -name 'x.tif*' | wc -l)" -eq 1 ]
}
