#!/usr/bin/env bats
# Machines of a farm that are not as they should be: one line each, nothing mixed, nothing lost. A
# stand-in for POV-Ray counts what is rendered.
load farm

setup() {
  needs faketime
  cd "$BATS_TEST_TMPDIR" || return 1
  echo '#include "canned.inc"' >fake.pov
  export FAKE_SECONDS=0.2 FAKE_LOG=$PWD/log.rendered
}

# Becomes a bake of some ten batches.
a_bake() {
  exec "$BAKESLAB" bake fake.pov --povray "$BUILD/tests/faults/fake_povray" --uv 64 --st 1 --rays 8 \
    --precision float --jobs 1 -q "$@"
}

whole() {
  (a_bake -o whole.tif)
  wanted=$(counted)
}

counted() { awk '$1 != 16 { sum += $1 * $2 } END { print sum + 0 }' log.rendered && rm log.rendered; }

# in_mounts COMMAND BAKE-OPTION...: a bake that sees other mounts, which the command made.
in_mounts() {
  local mounts=$1
  shift
  unshare -m true 2>/dev/null || skip 'mounts cannot be made here'
  unshare -m sh -c "$mounts && exec \"\$@\"" sh "$BAKESLAB" bake fake.pov \
    --povray "$BUILD/tests/faults/fake_povray" --uv 64 --st 1 --rays 8 --precision float --jobs 1 -q "$@"
}

@test "clocks that differ by an hour: each batch is rendered once" {
  whole
  local k shifts=(+3600s -3600s +0s) pids=()
  for k in 0 1 2; do
    (
      export NO_FAKE_STAT=1 # files have the times that their server gives them
      exec faketime -f "${shifts[k]}" "$BAKESLAB" bake fake.pov --povray "$BUILD/tests/faults/fake_povray" --uv 64 \
        --st 1 --rays 8 --precision float --jobs 1 -q -o x.tif
    ) >>log 2>&1 3>&- &
    pids[k]=$!
  done
  for k in 0 1 2; do wait "${pids[k]}" || { cat log && false; }; done
  same x.tif whole.tif
  [ "$(counted)" -eq "$wanted" ]
  [ ! -e x.tif.partial ]
}

@test "a folder that one worker may only read: it says so, and the others bake on" {
  whole
  (a_bake -o x.tif) 3>&- &
  wait_for_batches x.tif.partial 1
  refuses 1 "x.tif.partial" "Read-only file system" -- \
    in_mounts "mount --bind $PWD $PWD && mount -o remount,ro,bind $PWD && cd $PWD" -o x.tif
  wait "$!"
  same x.tif whole.tif
  [ "$(counted)" -eq "$wanted" ]
}

@test "the disk of one shard is full: the others have what they baked" {
  whole
  mkdir small big
  refuses 1 "No space left on device" -- in_mounts \
    "mount -t tmpfs -o size=300k none small" -o small/x.tif --shard 1/2
  (a_bake -o big/x.tif --shard 2/2)
  "$BAKESLAB" gather big/x.tif.partial -o x.tif.partial
  [ "$("$BAKESLAB" status --missing x.tif.partial)" = 1 ]
  (a_bake -o x.tif)
  same x.tif whole.tif
}

@test "a worker of another version of POV-Ray" {
  whole
  (a_bake -o x.tif) 3>&- &
  wait_for_batches x.tif.partial 1
  FAKE_VERSION=3.8.0 refuses 1 "x.tif.partial: " "POV-Ray 3.7.0.fake, not 3.8.0" -- a_bake -o x.tif
  wait "$!"
  same x.tif whole.tif
  [ "$(counted)" -eq "$wanted" ]
}

@test "shards of different numbers are not brought together" {
  mkdir one two
  (a_bake -o one/x.tif --uniform --shard 1/2)
  (a_bake -o two/x.tif --uniform --shard 2/3)
  refuses 1 "two/x.tif.partial: " "3 shards" -- "$BAKESLAB" gather one/x.tif.partial two/x.tif.partial -o x.tif.partial
  [ ! -e x.tif.partial ]
}
