#!/bin/sh
# summary.sh LOG... - adds up what run.sh counted; the last line is
# "N passed, N failed". Skipped cases are listed with their reasons.
passed=0 failed=0
for log in "$@"; do
  read -r p f _ <"$log.count" || exit 1
  passed=$((passed + p)) failed=$((failed + f))
done
grep -ahE '^(not )?ok [0-9]+.*# *(SKIP|skip)' "$@" | sed 's/^/skipped: /'
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
