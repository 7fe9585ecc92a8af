#!/bin/sh
# figures.sh SINCE BUILD... - what `make sanitize` tried, from the logs of its builds that are
# newer than the file SINCE.
since=$1
shift
builds=$*

# texts PATTERN: those logs, one after the other.
texts() {
  # shellcheck disable=SC2086 # folders without blanks
  find $builds -path "*/tests/$1" -newer "$since" -exec cat {} + 2>/dev/null
}
# tell "WHAT" WORD: the sum of the numbers in lines `# N WORD ...`
tell() {
  texts 'faults/*.log' | sed -n "s/^[# ]*\([0-9][0-9]*\) $2.*/\1/p" |
    awk -v what="$1" '{ n += $1 } END { printf "%10d  %s\n", n, what }'
}
echo 'Tried, without a crash, a hang or a report of a sanitizer:'
tell 'mutated slabs' mutants
tell 'faults: allocations, writes and pipes that failed' faults
tell 'bakes killed' kills
tell 'pairs of bakes of one output' pairs
texts 'fuzz/*.fuzz.log' | sed -n 's/^stat::number_of_executed_units: *//p' |
  awk '{ n += $1 } END { printf "%10d  inputs of fuzzers\n", n }'
texts '*.log.count' | awk '{ n += $1 } END { printf "%10d  tests\n", n }'
