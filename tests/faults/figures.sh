#!/bin/sh
# figures.sh BUILD... - what `make sanitize` tried, from the logs of its builds.
tell() { # "WHAT" PATTERN FILE...: the sum of the numbers before PATTERN
  what=$1 pattern=$2
  shift 2
  printf '%10d  %s\n' "$(cat "$@" 2>/dev/null | sed -n "s/^[# ]*\([0-9][0-9]*\) $pattern.*/\1/p" | awk '{ n += $1 } END { print n + 0 }')" "$what"
}
logs=
for build in "$@"; do logs="$logs $build/tests/faults/*.log"; done
echo 'Tried, without a crash, a hang or a report of a sanitizer:'
# shellcheck disable=SC2086 # patterns
{
  tell 'mutated slabs' 'mutants' $logs
  tell 'faults: allocations, writes and pipes that failed' 'faults' $logs
  tell 'bakes killed' 'kills' $logs
  tell 'pairs of bakes of one output' 'pairs' $logs
}
for build in "$@"; do
  cat "$build"/tests/fuzz/*.fuzz.log 2>/dev/null
done | sed -n 's/^stat::number_of_executed_units: *//p' | awk '{ n += $1 } END { printf "%10d  inputs of fuzzers\n", n }'
for build in "$@"; do
  find "$build/tests" -name '*.log.count' -exec cat {} + 2>/dev/null |
    awk -v build="$build" '{ p += $1; f += $2 } END { if (p + f) printf "%10d  tests passed, %d failed in %s\n", p, f, build }'
done
