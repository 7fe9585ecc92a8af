#!/usr/bin/env bash
# Many processes at one slab. What sharing costs: a claim, beside the CPU of a small batch of the
# paper's lamp, its bulb alone; by 64 processes on one folder, too. What is rendered, by a stand-in for POV-Ray
# that notes it, over what one process renders: by four processes on one folder, by four of which one
# is killed and begun again 20 times, by four shards in folders of their own, in waves; and whether
# the samples are the same.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
work=$(mktemp -d shared.XXXXXX)
cd "$work"
trap 'cd .. && rm -rf "$work"' EXIT
echo '#include "canned.inc"' >fake.pov
export FAKE_SECONDS=0.3 FAKE_LOG=$PWD/noted

a_bake() {
  exec "$BAKESLAB" bake fake.pov --povray "$TESTS/faults/fake_povray" --uv 48 --st 1 --rays 8 \
    --effects "$effects" --precision float --jobs 1 -q "$@" >/dev/null 2>>log
}
# Pixels noted since the last call, but for trial runs.
noted() {
  awk '$1 != 16 { sum += $1 * $2 } END { print sum + 0 }' noted
  rm noted
}
same() { "$BAKESLAB" diff --tolerance 0 "$1" "$2" >/dev/null; }

# killed COUNT: four processes; the next one of them is killed and begun again, so many times or
# until the slab is there. Prints how often.
killed() {
  local pids=() k kills delay
  for k in 0 1 2 3; do (a_bake -o killed.exr) & pids[k]=$!; done
  for ((kills = 0; kills < $1; ++kills)); do
    printf -v delay '0.%03d' $((RANDOM % 300))
    sleep "$delay"
    k=$((kills % 4))
    kill -KILL "${pids[k]}" 2>/dev/null || break
    wait "${pids[k]}" 2>/dev/null || true
    [ ! -e killed.exr ] || break
    (a_bake -o killed.exr) & pids[k]=$!
  done
  wait || true
  echo "$kills"
}

# shards: four folders, in waves until the pilots are whole.
shards() {
  local k
  mkdir 1.shard 2.shard 3.shard 4.shard
  while :; do
    for k in 1 2 3 4; do (a_bake -o $k.shard/x.exr --shard $k/4 --round pilot); done
    "$BAKESLAB" gather -q ./?.shard/x.exr.partial -o shards.exr.partial
    for k in 1 2 3 4; do "$BAKESLAB" gather -q shards.exr.partial -o $k.shard/x.exr.partial; done
    ! (a_bake -o 1.shard/x.exr --shard 1/4 --round rest) || break
  done
  for k in 2 3 4; do (a_bake -o $k.shard/x.exr --shard $k/4 --round rest); done
  "$BAKESLAB" gather -q ./?.shard/x.exr.partial -o shards.exr.partial
  (a_bake -o shards.exr)
}

over() { calc %.4f "$1/$one"; }
# told WHAT BY MOST FILE: a row of what was rendered.
told() { row "$effects: $1" "$2" "<= $3" "$(holds "$2 <= $3") $(same one.exr "$4" && echo 'same bits')"; }

heading 'Many processes at one slab'
alone=$("$TOOLS/claims" 1 256 claims1)
many=$("$TOOLS/claims" 64 256 claims64)
# Two batches of half a million rays.
spend batch "$BAKESLAB" bake "$root/lamps/parabolic.pov" -o batch.tif --uv 8 --st 64 --rays 4 --uniform --effects none --window declared -q
batch=$(calc %.2f "$(cat batch.cpu)/2")
share=$(calc %.4f "100 * 1e-6 * $alone / $batch")
row 'a claim: CPU us' "$alone"
row "over a batch of $batch CPU s, %" "$share" '<= 1' "$(holds "$share <= 1")"
share=$(calc %.4f "100 * 1e-6 * $many / $batch")
row 'the same by 64 processes on one folder, %' "$share" '<= 1' "$(holds "$share <= 1")"
for effects in none interreflection; do
  rm -rf ./*.exr ./*.partial ./*.shard noted
  (a_bake -o one.exr)
  one=$(noted)
  for k in 1 2 3 4; do (a_bake -o four.exr) & done
  wait
  told 'four processes: rays over those of one' "$(over "$(noted)")" 1.01 four.exr
  RANDOM=1
  kills=$(killed 20)
  told "four processes and $kills kills: rays finished" "$(over "$(noted)")" 1.05 killed.exr
  shards
  told 'four shards in folders of their own' "$(over "$(noted)")" 1.01 shards.exr
done
