# needs.bash - what tests of programs that others wrote begin with.
# shellcheck shell=bash

# needs TOOL...: fails where one is missing. Set-up brings them all, so that no test is skipped.
needs() {
  local tool
  for tool; do
    command -v "$tool" >/dev/null || { echo "$tool is missing: run make setup"; return 1; }
  done
}
