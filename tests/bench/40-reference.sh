#!/usr/bin/env bash
# What the reference renderer's sums cost: the published algorithm (`paper`: a random sample
# a micro light, scalar double) against `pi` and `reference`, from interleaved repeats.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
repeats=${BENCH_REPEATS:-5}

# What `pi` computes for a micro light, in multiply-adds: 4 rows by 4 pixels, 4 pixels to one,
# times the kernel; the kernel.
work=67

# column FILE EXPRESSION: one number of each repeat; $2.. are paper, pi, reference (ns), bytes/ns,
# 1e9 multiply-adds a second fused and not.
column() { awk "\$1 == \"repeat\" { printf \"%.4g \", $2 }" "$1"; }
# over FILE EXPRESSION: its median and spread
over() { local x && read -ra x < <(column "$1" "$2"; echo) && spread "${x[@]}"; }
median() { local x && x=$(over "$@") && echo "${x%% *}"; }

measure() { # UV ST plane|scattered WHERE
  local file=sum-$1-$2-$3.txt visible tile alone paper pi reference bound
  "$TOOLS/sum" times "$1" "$2" "$3" "$repeats" >"$file"
  read -r visible tile alone < <(sed -n 's/^visible //p' "$file")
  read -r paper pi reference < <(sed -n 's/^error //p' "$file")
  heading "$1x$1 x $2x$2 samples, $4: $visible micro lights a receiver"
  printf '  %-12s %24s %14s\n' '' 'ns a micro light' 'relative RMS'
  printf '  %-12s %24s %14s\n' paper "$(over "$file" '$2')" "$paper" \
    pi "$(over "$file" '$3')" "$pi" reference "$(over "$file" '$4')" "$reference"
  row 'paper over pi: time' "$(over "$file" '$2/$3')" '>= 5' "$(holds "$(median "$file" '$2/$3') >= 5")"
  row 'paper over pi: error' "$(calc %.0f "$paper/$pi")" '>= 10' "$(holds "$paper/$pi >= 10")"
  row 'paper over reference: time' "$(over "$file" '$2/$4')"
  printf '  roofline, one core: reads the slab at %s GB/s, does %s G multiply-adds/s\n' \
    "$(over "$file" '$5')" "$(over "$file" '$6')"
  printf '    (%s G in 8 lanes, not fused, as the code must for the same bits everywhere)\n' "$(over "$file" '$7')"
  printf '    pi needs %s of them a micro light and %s bytes of the slab (%s for one receiver alone)\n' \
    "$work" "$tile" "$alone"
  bound=memory
  holds "$(median "$file" "$tile/\$5") > $(median "$file" "$work/\$7")" | grep -q ok || bound=arithmetic
  local limit="($tile/\$5 > $work/\$7 ? $tile/\$5 : $work/\$7)"
  row "pi over its bound, $bound of $(median "$file" "$limit") ns" "$(over "$file" "\$3/$limit")" '<= 3' \
    "$(holds "$(median "$file" "\$3/$limit") <= 3")"
  row 'pi over the bound by fused multiply-adds in the widest registers' "$(over "$file" "\$3/($work/\$6)")"
}

for slab in '64 64' '16 64'; do
  read -r uv st <<<"$slab"
  measure "$uv" "$st" plane 'neighbours on a plane 4 apertures away'
  measure "$uv" "$st" scattered 'receivers scattered 0.5 to 8 apertures away'
done

heading 'Micro lights visited by receivers 0.5 to 8 apertures away, against the resolution'
printf '  %-8s %-8s %10s %10s %12s %12s %16s\n' uv st mean most 'mean/max^2' 'most/max^2' 'pi, us/receiver'
"$TOOLS/sum" visits | while read -r uv st mean most relative worst time; do
  printf '  %-8s %-8s %10s %10s %12s %12s %16s\n' "${uv}x$uv" "${st}x$st" "$mean" "$most" "$relative" "$worst" "$time"
done
echo '  max^2: max(Nu,Ns) max(Nv,Nt), as which the paper says the cost grows'
