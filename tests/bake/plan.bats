#!/usr/bin/env bats
# What a bake says before it begins, and when it asks.
bats_require_minimum_version 1.5.0
load bake

setup() { bake_setup; }

@test "on a terminal more than an hour asks for --yes; --dry-run and small bakes do not" {
  command -v script >/dev/null
  # 1.7e10 rays.
  long="'$BAKESLAB' bake flat.pov --uv 32 --st 64 --rays 4096 --jobs 1 -o long.tif"
  run timeout 60 script -qec "$long" /dev/null
  echo "$output"
  [ "$status" -eq 1 ]
  [[ $output == *"flat.pov: the bake may take more than an hour; say --yes to begin it"* ]]
  [ ! -e long.tif ] && [ ! -e long.tif.partial ]
  run timeout 60 script -qec "$long --dry-run" /dev/null
  [ "$status" -eq 0 ] && [ -d long.tif.partial ]
  # With --yes it begins: after some seconds it is still at work.
  run timeout 8 script -qec "$long --yes" /dev/null
  [ "$status" -eq 124 ]
  run timeout 60 script -qec "'$BAKESLAB' bake flat.pov --uv 2 --st 4 --rays 4 -o short.tif" /dev/null
  [ "$status" -eq 0 ] && [ -s short.tif ]
}

@test "the memory that --dry-run estimates is that of the bake, within a factor 2" {
  needs ps
  plan=(bake flat.pov --uv 24 --st 64 --rays 4 --jobs 1 --uniform -o m.tif)
  estimate=$("$BAKESLAB" "${plan[@]}" --dry-run 2>&1 | sed -n 's/.*memory \([0-9.e+]*\) MB.*/\1/p')
  # The program's and POV-Ray's, which run at the same time; sampled, in kB.
  "$BAKESLAB" "${plan[@]}" -q 3>&- &
  pid=$! most=0
  while kill -0 $pid 2>/dev/null; do
    now=$(ps -o rss= --pid $pid --ppid $pid 2>/dev/null | awk '{ s += $1 } END { print s + 0 }')
    [ "$now" -gt "$most" ] && most=$now
    sleep 0.02
  done
  wait $pid
  echo "estimated $estimate MB, took $most kB"
  awk -v e="$estimate" -v m="$most" 'BEGIN { exit !(e * 1e3 < 2 * m && e * 1e3 > m / 2) }'
}

@test "--window auto looks beyond the window, unless it is final" {
  for final in false true; do
    flat_lamp w.pov "#declare Canned_Window_Is_Final = $final;"
    sed -i 's/<-1, 1, -1, 1>/<-0.5, 0.5, -0.5, 0.5>/' w.pov
    bake w.pov --uv 2 --st 4 --rays 4 --window auto -q -o "$final.tif"
    "$BAKESLAB" info "$final.tif" | tee "$final.txt"
  done
  grep "st window" false.txt
  run ! grep -E "st window +-0.5" false.txt
  grep -E 'st window +-0.5' true.txt
}
