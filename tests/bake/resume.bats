#!/usr/bin/env bats
# Nothing is lost: a bake that was interrupted, killed or damaged goes on from its
# finished batches to the same samples, but not from those of a script that has changed.
load bake

setup() {
  bake_setup
  slow_lamp
}

# whole: the samples to compare with, baked once.
whole() {
  [ -f "$BATS_FILE_TMPDIR/whole.tif" ] || slow -q -o "$BATS_FILE_TMPDIR/whole.tif"
  ln -sf "$BATS_FILE_TMPDIR/whole.tif" whole.tif
}

# Starts a bake of x.tif and ends it with a signal as soon as it has a batch.
interrupt() {
  begin_slow --jobs 1
  kill "-$1" $!
  local status=0
  wait $! || status=$?
  cat log
  [ "$status" -ne 0 ]
  [ ! -e x.tif ]
  [ "$(finished x.tif.partial)" -ge 1 ]
}

goes_on() {
  run -0 slow -o x.tif
  echo "$output"
  [[ $output =~ ([0-9]+)\ batches,\ ([0-9]+)\ of\ them\ found ]]
  [ "${BASH_REMATCH[2]}" -ge "$1" ]
  [ "${BASH_REMATCH[2]}" -lt "${BASH_REMATCH[1]}" ]
  [ ! -e x.tif.partial ]
  same x.tif whole.tif
}

@test "SIGINT: one line, no process left, and the next run goes on" {
  whole
  interrupt INT
  [ "$(cat log)" = "bakeslab: interrupted; finished batches are in x.tif.partial, and the same command goes on from them" ]
  no_process_left 4 # each would run for half a second and more
  [ -z "$(find x.tif.partial -name '*.tmp*')" ]
  goes_on 1
}

@test "kill -9: POV-Ray dies too" {
  whole
  interrupt KILL
  no_process_left 4 # each would run for half a second and more
  goes_on 1
}

@test "killed again and again at any moment" {
  whole
  local delay
  for delay in 0.05 0.3 0.7 1.1 1.6; do
    BAKE_EXEC="timeout -s KILL $delay" slow -o x.tif >log 2>&1 || true
  done
  slow -q -o x.tif
  same x.tif whole.tif
  [ ! -e x.tif.partial ]
}

@test "a batch that was damaged is baked again" {
  whole
  interrupt TERM
  no_process_left 4 # each would run for half a second and more
  local frame
  frame=$(find x.tif.partial -name frame.exr | head -n 1)
  truncate -s 5000 "$frame"
  run -0 slow -o x.tif
  same x.tif whole.tif
  rm x.tif
  interrupt HUP
  find x.tif.partial -name frame.exr -delete
  run -0 slow -o x.tif
  echo "$output"
  [[ $output == *", 0 of them found"* ]]
  same x.tif whole.tif
}

@test "a changed include makes old batches unused, even one with a computed name" {
  whole
  interrupt INT
  echo '#declare Part = 0.25;' >parts.inc
  run -0 slow -o x.tif
  echo "$output"
  [[ $output == *", 0 of them found"* ]]
  run ! same x.tif whole.tif
  rm x.tif
  echo '#declare Part = 0.5;' >parts.inc
  interrupt INT
  sed -i 's/rgb 1 rgb/rgb 0.5 rgb/' slow.pov
  run slow -o x.tif
  [[ $output == *", 0 of them found"* ]]
}

@test "other options make old batches unused" {
  interrupt INT
  run -0 slow -o x.tif --st 8x9
  echo "$output"
  [[ $output == *", 0 of them found"* ]]
}

@test "another bake of the same output is refused while one is at work, which goes on" {
  whole
  begin_slow --jobs 1
  local pid=$! # `run` has processes of its own
  kill -STOP "$pid"
  run -1 slow -o x.tif --st 8x9
  echo "$output"
  [[ $output == "bakeslab: x.tif.partial: another bake of this output is at work (process $pid on "*": other options); wait for it" ]]
  kill -CONT "$pid"
  wait "$pid"
  same x.tif whole.tif
}

# Starts a bake, changes parts.inc or the script (a command) when it has a batch.
change_meanwhile() {
  local status=0
  begin_slow --jobs 1
  eval "$1"
  wait $! || status=$?
  cat log
  [ "$status" -eq 1 ]
  [ "$(wc -l <log)" -eq 1 ]
  [ ! -e x.tif ]
}

@test "an include that changes while a bake runs stops it; no batch made after it is used" {
  whole
  change_meanwhile "echo '#declare Part = 0.25;' >parts.inc"
  [[ $(cat log) == bakeslab*parts.inc*changed* ]]
  echo '#declare Part = 0.5;' >parts.inc
  run -0 slow -o x.tif
  same x.tif whole.tif
}

@test "a script that changes while a bake runs stops it; none of its batches is used after" {
  whole
  change_meanwhile "sed -i 's/rgb 1 rgb/rgb 0.5 rgb/' slow.pov"
  [[ $(cat log) == bakeslab*slow.pov*changed* ]]
  run -0 slow -o x.tif
  [[ $output == *", 0 of them found"* ]]
  run ! same x.tif whole.tif
}

@test "a file read only when an effect is on is among what old batches depend on" {
  cat >only.inc <<<'#declare Part = 0.25;'
  sed -i 's/^Canned_Needs.*/&\n#if (Canned_Extended_Source_) #include "only.inc" #end/' slow.pov
  sed -i 's/Canned_Needs("")/Canned_Needs("extended_source")/' slow.pov
  interrupt INT
  echo '#declare Part = 0.125;' >only.inc
  run -0 slow -o x.tif
  echo "$output"
  [[ $output == *", 0 of them found"* ]]
}
