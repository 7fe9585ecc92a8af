#!/usr/bin/env bash
# measure.sh LAMP KIND BAKE OPTION... - lines for times.txt: what each batch of the first and the
# last round of a bake takes, by POV-Ray's own count of CPU seconds. KIND: interreflection, caustics
# or none. Bakes of `--uv 4`, `--uv 8` and more are called "sizes", one that has a last round
# "rounds":
#   for n in 4 8 16; do measure.sh torch caustics sizes --uv $n --st 64 --rays 8; done
#   measure.sh torch caustics rounds --uv 16 --st 64 --rays 16
# With BAKESLAB, where it is not installed.
set -euo pipefail
lamp=$1 kind=$2 bake=$3
shift 3
script=$(realpath "$(dirname "$0")/../../lamps/$lamp.pov")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# In shards, since the batches of a slab that is written go.
for k in 1 2; do
  "${BAKESLAB:-bakeslab}" bake "$script" -o "$folder/x.tif" --window declared --jobs 1 -q --shard $k/2 "$@"
done

# of ROUND LIST: a line for each batch of a round.
of() {
  local round=$1 key rays
  while read -r key rays; do
    local batch=$folder/x.tif.partial/$key
    echo "$lamp $kind $bake $round $rays $(grep -c '^mesh {' "$batch/scene.pov") $(
      tr '\r' '\n' <"$batch/log" | awk '/ thread\(s\) with / { sum += $(NF - 2) } END { printf "%.3f", sum }'
    )"
  done < <(tail -n +2 "$2")
}
of first "$folder/x.tif.partial/round.1"
for list in "$folder"/x.tif.partial/round.*; do
  if grep -q '^bake ' "$list"; then of last "$list"; fi
done
