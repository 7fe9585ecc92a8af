#!/usr/bin/env bats
# Many processes at one slab: on one folder, where each batch is rendered once, whoever dies; in
# folders of their own, by shards and waves. A stand-in for POV-Ray counts what is rendered.
load bake

setup() {
  needs jq
  cd "$BATS_TEST_TMPDIR" || return 1
  echo '#include "canned.inc"' >fake.pov
  export FAKE_SECONDS=0.2 FAKE_LOG=$PWD/rendered
  RANDOM=1
}

# Becomes a bake of 8 batches and more.
a_bake() {
  exec "$BAKESLAB" bake fake.pov --povray "$BUILD/tests/faults/fake_povray" --uv 48 --st 1 --rays 8 \
    --precision float --jobs 1 -q "$@"
}

# whole OPTION...: whole.tif and how much it takes, by one process; then nothing is counted.
whole() {
  (a_bake -o whole.tif "$@")
  wanted=$(rendered)
  rm rendered
}

# Pixels that were rendered, but for trial runs.
rendered() { awk '$1 != 16 { sum += $1 * $2 } END { print sum + 0 }' rendered; }

@test "processes on one folder share its batches: each is rendered once, and the slab is the same" {
  whole
  local k
  for k in 1 2 3; do (a_bake -o x.tif) >log.$k 2>&1 3>&- & done
  wait_for_batch x.tif.partial
  "$BAKESLAB" status --json x.tif.partial >told
  jq -e '.jobs == 3 and (.workers | length) == 3 and (.claims | length) <= 3 and
    (.rounds | all(.done + .claimed + .missing == .batches)) and (.rays_done > 0)' told
  wait
  same x.tif whole.tif
  [ "$(rendered)" -eq "$wanted" ]
  [ ! -e x.tif.partial ]
}

@test "killed at random moments, they lose no more than what they had in hand" {
  whole
  local k delay kills=8 pids=()
  for k in 0 1 2 3; do (a_bake -o x.tif) >>log 2>&1 3>&- & pids[k]=$!; done
  for ((k = 0; k < kills; ++k)); do
    printf -v delay '0.%03d' $((RANDOM % 200))
    sleep "$delay"
    kill -KILL "${pids[k % 4]}" 2>/dev/null || break # the slab is there
    wait "${pids[k % 4]}" || true
    (a_bake -o x.tif) >>log 2>&1 3>&- &
    pids[k % 4]=$!
  done
  wait
  cat log
  [ "$k" -ge 4 ]
  same x.tif whole.tif
  [ ! -e x.tif.partial ]
}

@test "shards in folders of their own, in two waves: nothing is rendered twice" {
  whole --effects interreflection
  local k pilot=('' pilot pilot next) rest=('' rest next rest) # the next is what is called for
  for k in 1 2 3; do
    mkdir $k
    (a_bake -o $k/x.tif --effects interreflection --shard $k/3 --round "${pilot[k]}")
  done
  refuses 1 "1/x.tif.partial: " "batches of pilot 1 are missing" "bakeslab gather" \
    -- a_bake -o 1/x.tif --effects interreflection --shard 1/3 --round rest
  "$BAKESLAB" gather ./?/x.tif.partial -o all.tif.partial
  [ "$("$BAKESLAB" status --missing all.tif.partial)" = 1-3 ] # the rest is to be planned
  for k in 1 2 3; do
    "$BAKESLAB" gather -q all.tif.partial -o $k/x.tif.partial
    (a_bake -o $k/x.tif --effects interreflection --shard $k/3 --round "${rest[k]}")
  done
  [ "$("$BAKESLAB" status --missing 2/x.tif.partial)" = 1,3 ]
  "$BAKESLAB" gather -q ./?/x.tif.partial -o x.tif.partial
  [ -z "$("$BAKESLAB" status --missing x.tif.partial)" ]
  (a_bake -o x.tif --effects interreflection)
  same x.tif whole.tif
  [ "$(rendered)" -eq "$wanted" ]
}

@test "folders of other bakes, versions and numbers of shards are told, and nothing is mixed" {
  local there
  (a_bake -o x.tif --uniform --shard 1/3)
  there=$(find x.tif.partial | sort)
  refuses 1 "x.tif.partial: is shared out into 3 shards, not 4" -- a_bake -o x.tif --uniform --shard 2/4
  refuses 1 "x.tif.partial: holds shards of another bake (other options)" -- a_bake -o x.tif --shard 2/3
  FAKE_VERSION=3.8.0 refuses 1 "(POV-Ray 3.7.0.fake, not 3.8.0)" -- a_bake -o x.tif --uniform --shard 2/3
  echo '// changed' >>fake.pov
  refuses 1 "(another script, or other files that it reads)" -- a_bake -o x.tif --uniform --shard 2/3
  [ "$(find x.tif.partial | sort)" = "$there" ]
  (a_bake -o y.tif --uniform --shard 2/3)
  refuses 1 "y.tif.partial: is of another bake than x.tif.partial" "nothing is copied" \
    -- "$BAKESLAB" gather x.tif.partial y.tif.partial -o z.tif.partial
  mkdir empty
  refuses 1 "empty: no bake's folder" -- "$BAKESLAB" gather x.tif.partial empty -o z.tif.partial
  refuses 1 "empty: no bake's folder" -- "$BAKESLAB" status empty
  [ ! -e z.tif.partial ]
}

@test "batches that were cut off are told and left out; other pixels are told and left" {
  whole --uniform
  local first second
  (a_bake -o x.tif --uniform --shard 1/2)
  cp -r x.tif.partial copy
  first=$(find copy -name frame.exr | sort | head -n 1)
  truncate -s 3000 "$first"
  rm copy/"$(basename "$(dirname "$(find copy -name frame.exr | sort | tail -n 1)")")"/render.ini
  run -0 "$BAKESLAB" gather copy -o y.tif.partial
  echo "$output"
  [[ $output == *"$first: page 1: damaged or truncated"*"left out"*"2 are damaged and left out" ]]
  [[ $output == *": render.ini is missing or cut off; left out"* ]]
  (a_bake -o y.tif --uniform)
  same y.tif whole.tif
  rm -r copy && cp -r x.tif.partial copy
  second=$(find copy -name frame.exr | sort | sed -n 2p)
  cp "$second" "$first"
  run -1 "$BAKESLAB" gather copy -o x.tif.partial
  echo "$output"
  [[ $output == *"$(dirname "$first"): has other pixels than x.tif.partial/"*"1 batches differ"* ]]
  # What is damaged where it goes gives way.
  rm -r copy && cp -r x.tif.partial copy
  truncate -s 3000 "${first/copy/x.tif.partial}"
  "$BAKESLAB" gather copy -o x.tif.partial
  cmp "$first" "${first/copy/x.tif.partial}"
}
