#!/bin/sh
# summary.sh LOG... - adds up what run.sh counted; the last line is
# "N passed, N failed". Skipped cases are listed with their reasons. With CI set (.ci/run),
# where set-up brings every program, what is skipped for want of one, or for no reason, failed.
passed=0 failed=0
for log in "$@"; do
  read -r p f _ <"$log.count" || exit 1
  passed=$((passed + p)) failed=$((failed + f))
done
skipped=$(grep -ahE '^(not )?ok [0-9]+.*# *(SKIP|skip)' "$@")
[ -z "$skipped" ] || printf '%s\n' "$skipped" | sed 's/^/skipped: /'
if [ -n "${CI-}" ]; then
  lacking=$(printf '%s\n' "$skipped" | grep -cE '# *(SKIP|skip) *(no .*|.* not installed)?$')
  [ "$lacking" -eq 0 ] || echo "$lacking skipped for want of what set-up brings"
  failed=$((failed + lacking))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
