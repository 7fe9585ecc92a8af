#!/usr/bin/env bash
# What ray files cost, binary and as text: CPU seconds, time to wait and memory. Samples are estimated
# once all rays are counted, which takes as long for few rays as for many. Two threads share both.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p rays
cd rays

# import FILE OPTION...: CPU seconds in import.cpu, most memory in kB in import.memory.
import() {
  spend import "$TOOLS/peak" import.memory "$BAKESLAB" import "$1" -o lamp.exr --precision float -q "${@:2}"
}

heading 'Ray files: a Lambertian square millimetre, 16x16 x 64x64 samples (13 MB)'
for count in 100000 10000000 20000000; do
  "$TOOLS/rays" "$count" >lamp.tm25ray
  import lamp.tm25ray
  cp import.cpu "$count.cpu"
  row "TM-25, $count rays: CPU s" "$(cat import.cpu)"
  row "TM-25, $count rays: MB beside the slab" "$(calc %.0f "$(cat import.memory)/1e3 - 13")" '<= 300' \
    "$(holds "$(cat import.memory)/1e3 - 13 <= 300")"
done
rm lamp.tm25ray
others=$(cat import.others) # of what is waited for, what others do to it is told
row "TM-25, 20000000 rays: s to wait, others having $others %" "$(cat import.wall)"
rate=$(calc %.2f "20/$(cat import.wall)")
if [ "$others" -le 5 ]; then
  row '... million a second' "$rate" '>= 5' "$(holds "$rate >= 5 || $(nproc) < 2")"
else
  row '... million a second' "$rate"
fi
rate=$(calc %.2f "20/$(cat 20000000.cpu)")
row 'TM-25, 20000000 rays: million a CPU s' "$rate" '>= 2.5' "$(holds "$rate >= 2.5")"
row '... without what 100000 rays take' "$(calc %.2f "19.9/($(cat 20000000.cpu) - $(cat 100000.cpu))")"
awk 'BEGIN { srand(1); for (n = 0; n < 1e6; ++n) {
  r = sqrt(rand()); a = 6.283185307179586 * rand()
  printf "%.6f %.6f 0 %.6f %.6f %.6f 1e-6\n", rand(), rand(), r * cos(a), r * sin(a), sqrt(1 - r * r) } }' >lamp.txt
import lamp.txt --unit mm
row 'text, 1000000 rays: million a CPU s' "$(calc %.2f "1/$(cat import.cpu)")"
