# testing.bash - what tests of the programs share: bats with `run -STATUS`, programs that are
# needed, and how a program refuses.
# shellcheck shell=bash
bats_require_minimum_version 1.5.0
load ../needs

# refuses STATUS PIECE... -- COMMAND...: it exits so (a pattern, [12] say), with one line on stderr
# that begins with a program's name and says all of the pieces.
# shellcheck disable=SC2053,SC2154 # STATUS is a pattern; status and stderr are set by run
refuses() {
  local wanted=$1 pieces=() piece
  while shift && [ "$1" != -- ]; do pieces+=("$1"); done
  shift
  run --separate-stderr "$@"
  [[ $status == $wanted ]] || { echo "status $status: $stderr"; return 1; }
  [ "${#stderr_lines[@]}" -eq 1 ] || { echo "not one line: $stderr"; return 1; }
  [[ $stderr == @(bakeslab|renderslab)*": "* ]] || { echo "no program's name: $stderr"; return 1; }
  for piece in "${pieces[@]}"; do
    [[ $stderr == *"$piece"* ]] || { echo "'$stderr' does not say '$piece'"; return 1; }
  done
}
