#!/usr/bin/env bash
# What ray files cost: rays a second and memory, by their number, binary and as text. CPU seconds of
# all cores together; two cores give twice as much a second.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p rays
cd rays

# import FILE OPTION...: CPU seconds in import.cpu, most memory in kB in import.memory.
import() {
  spend import "$TOOLS/peak" import.memory "$BAKESLAB" import "$1" -o lamp.exr --precision float -q "${@:2}"
}

# report COUNT FILE NAME
report() {
  local rate
  import "$2"
  rate=$(calc %.2f "$1/$(cat import.cpu)/1e6")
  if [ "$1" -lt 1000000 ]; then
    row "$3, $1 rays: CPU s" "$(cat import.cpu)"
  else
    row "$3, $1 rays: million a CPU s" "$rate" '>= 2.5' "$(holds "$rate >= 2.5")"
  fi
  row "$3, $1 rays: MB" "$(calc %.0f "$(cat import.memory)/1e3")" '<= 313' "$(holds "$(cat import.memory) <= 313e3")"
}

heading 'Ray files: a Lambertian square millimetre, 16x16 x 64x64 samples (13 MB)'
for count in 100000 1000000 10000000 20000000; do
  "$TOOLS/rays" "$count" >lamp.tm25ray
  report "$count" lamp.tm25ray TM-25
done
rm lamp.tm25ray
awk 'BEGIN { srand(1); for (n = 0; n < 1e6; ++n) {
  r = sqrt(rand()); a = 6.283185307179586 * rand()
  printf "%.6f %.6f 0 %.6f %.6f %.6f 1e-6\n", rand(), rand(), r * cos(a), r * sin(a), sqrt(1 - r * r) } }' >lamp.txt
import lamp.txt --unit mm
row 'text, 1000000 rays: million a CPU s' "$(calc %.2f "1/$(cat import.cpu)")"
