#!/bin/sh
# run.sh NAME... - lets each fuzzer work for its part of FUZZ_SECONDS; a line each, and their
# sum. What they learn is kept in build/fuzz/ for the next time; an input that fails is too,
# and is named: make it a seed. `build/fuzz/tests/fuzz/fuzz_NAME INPUT` runs it again.
status=0 all=0
part=$((FUZZ_SECONDS / $#))
[ "$part" -ge 1 ] || part=1
for name in "$@"; do
  learnt=$BUILD/corpus/$name
  log=$BUILD/tests/fuzz/$name.fuzz.log
  mkdir -p "$learnt"
  # No 4 kB need half a GB; no reader takes 10 seconds over them.
  if ! "$BUILD/tests/fuzz/fuzz_$name" -max_total_time="$part" -seed=1 -max_len=4096 -timeout=10 \
    -malloc_limit_mb=512 -print_final_stats=1 -artifact_prefix="$learnt-" \
    "$learnt" "tests/fuzz/seeds/$name" >"$log" 2>&1; then
    echo "FAIL fuzz/$name: $log"
    grep -vE '^(#[0-9]|stat::)' "$log" | tail -n 40
    status=1
  fi
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  printf 'fuzz/%-12s %9d inputs\n' "$name" "${inputs:=0}"
  all=$((all + inputs))
done
echo "$all inputs tried by $# fuzzers"
exit "$status"
