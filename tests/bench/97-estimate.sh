#!/usr/bin/env bash
# Rays of three sources of known radiance, and a smooth one, as samples of 16x16 x 64x64: RMS error
# of the samples' radiance over the etendue, relative, against what is told and what plain bins have.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"

# report SOURCE RAYS SEEDS [UV ST]
report() {
  local true_error told bins adding estimating held_out
  read -r true_error told bins adding estimating held_out < <("$TOOLS/estimate" "$@")
  row "$1, $2 rays: error, %" "$(calc %.3f "100*$true_error")"
  row "$1, $2 rays: told, %" "$(calc %.3f "100*$told")" 'within 1.5 times' \
    "$(holds "$told <= 1.5*$true_error && $told >= $true_error/1.5")"
  [ "$held_out" = nan ] || row "$1, $2 rays: shown by rays held out, %" "$(calc %.3f "100*$held_out")"
  if [ "$2" = 100000 ]; then
    row "$1, $2 rays: bins, %" "$(calc %.0f "100*$bins")" '>= 3 times' "$(holds "$bins >= 3*$true_error")"
  else
    row "$1, $2 rays: bins, %" "$(calc %.0f "100*$bins")"
  fi
  [ -n "${4-}" ] || row "$1, $2 rays: CPU s" "$(calc %.1f "$adding*$2/1e6+$estimating")"
}

heading 'Samples by rays of known sources'
for rays in 100000 1000000 10000000; do
  report square "$rays" 16 4 16 # errs by its flux alone: the mean square over 16 seeds
  for source in beam bars lobe; do
    report "$source" "$rays" 1
  done
done
