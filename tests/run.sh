#!/bin/sh
# run.sh LOG COMMAND... - runs one test that speaks TAP and prints one line.
# The log is kept; it is printed where something failed. LOG.count gets
# "passed failed skipped" for summary.sh. Succeeds always: make goes on, and
# summary.sh fails. A test that dies early, prints no plan or takes longer than
# TEST_TIMEOUT seconds counts as a failure of its own.
log=$1
shift
start=$(date +%s)
timeout -k 10 "${TEST_TIMEOUT:-540}" "$@" >"$log" 2>&1 </dev/null
status=$?
seconds=$(($(date +%s) - start))
name=${log##*/tests/}
name=${name%.log}

awk -v status="$status" '
  /^1\.\.[0-9]+/ { planned += substr($1, 4) }
  /^(not )?ok [0-9]+.*# *(SKIP|skip)/ { skipped++; next }
  /^ok [0-9]+/ { passed++ }
  /^not ok [0-9]+/ { failed++ }
  END {
    lost = planned - passed - failed - skipped
    if (lost > 0) failed += lost
    if (!failed && (status != 0 || !planned)) failed = 1
    print passed + 0, failed + 0, skipped + 0
  }' "$log" >"$log.count"
read -r passed failed skipped <"$log.count"

if [ "$failed" -ne 0 ]; then
  # One write, so that tests running beside do not cut into it.
  text=$(echo "FAIL $name ($failed of $((passed + failed)), ${seconds} s, exit $status): $log"; sed 's/^/    /' "$log")
  printf '%s\n' "$text"
else
  note=
  [ "$skipped" -eq 0 ] || note=", $skipped skipped"
  printf 'ok   %-28s %3d passed%s, %d s\n' "$name" "$passed" "$note" "$seconds"
fi
