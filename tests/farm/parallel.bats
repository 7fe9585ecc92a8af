#!/usr/bin/env bats
# Bakes by GNU parallel over ssh, on one folder and by waves of shards in folders of their own; and
# workers that are killed at random moments.
load farm

setup_file() {
  load farm
  farm_begin
  ssh_begin
  alone cheap
  alone tin
}
teardown_file() { load farm && farm_end; }
setup() { cd "$BATS_FILE_TMPDIR" && rm -f rendered; }

@test "four machines on one folder: cheap lamp" {
  # shellcheck disable=SC2046
  canned-parallel -S machines -- $(cheap) -o one.tif -j 1
  same one.tif cheap.tif
  within "$(rendered)" "$(cat cheap.rays)" 1.01
  [ ! -e one.tif.parallel ]
}

@test "two machines, waves of shards that share no folder: interreflection" {
  head -n 2 machines >two
  # shellcheck disable=SC2046
  canned-parallel -S two --copy -- $(tin) -o apart.tif -j 1
  same apart.tif tin.tif
  within "$(rendered)" "$(cat tin.rays)" 1.01
  [ ! -e apart.tif.parallel ] && [ ! -e apart.tif.partial ]
}

@test "every third job killed by -9, and its machine tries again: cheap lamp" {
  local k victim
  # shellcheck disable=SC2046
  canned-parallel -S machines -n 6 -- $(cheap) -o killed.tif -j 1 >log 2>&1 3>&- &
  for k in 1 2; do
    wait_for_batches killed.tif.partial $((20 * k))
    victim=$("$BAKESLAB" status --json killed.tif.partial | jq '[.workers[] | select(.dead | not) | .process][0]')
    kill -KILL "$victim"
  done
  wait "$!" || { cat log && false; }
  same killed.tif cheap.tif
  within "$(rendered)" "$(cat cheap.rays)" 1.05
}

@test "twenty workers killed by -9 at random moments: nothing is lost" {
  local k delay kills=0 pids=() bake before
  RANDOM=7
  read -ra bake < <(cheap)
  for k in 0 1 2 3; do
    exec "${bake[@]}" -o x.tif -j 1 -q >>log 2>&1 3>&- &
    pids[k]=$!
  done
  wait_for_batches x.tif.partial 1
  while [ "$kills" -lt 20 ]; do
    printf -v delay '0.%03d' $((RANDOM % 700))
    sleep "$delay"
    before=$(find x.tif.partial -maxdepth 1 -name '????????????????????????????????' | sort)
    kill -KILL "${pids[kills % 4]}"
    wait "${pids[kills % 4]}" 2>/dev/null || true
    for k in $before; do [ -d "$k" ]; done
    exec "${bake[@]}" -o x.tif -j 1 -q >>log 2>&1 3>&- &
    pids[kills % 4]=$!
    kills=$((kills + 1))
  done
  wait
  cat log
  same x.tif cheap.tif
  [ ! -e x.tif.partial ]
  within "$(rendered)" "$(cat cheap.rays)" 1.5 # twenty of eighty batches, or twice as many
}
