#!/usr/bin/env bash
# Photometric files as slabs: flux against the table's own integral, and what the far field is off,
# at the default resolution. FILES= names others than those of lamps/. Then what the tests of the
# far field through POV-Ray and of the near field measure; in them openings, not files, are named.
set -euo pipefail
# shellcheck source=tests/bench/bench.bash
. "$(dirname "$0")/bench.bash"
mkdir -p photometric
heading "photometric files: error of the far field (RMS), flux, CPU seconds, samples"
# shellcheck disable=SC2086 # FILES is a list
for file in ${FILES:-"$root"/lamps/*.ies}; do
  spend photometric/import "$BAKESLAB" import -q "$file" -o photometric/slab.tif
  "$BAKESLAB" info --json photometric/slab.tif >photometric/info.json
  read -r error flux samples < <(jq -r '[.pages[0].provenance.import.error,
    (.pages[0].provenance.import | .flux_out / .flux_in - 1),
    ([.pages[].samples | reduce .[] as $n (1; . * $n)] | add)] | map(tostring) | join(" ")' photometric/info.json)
  row "$(basename "$file"): $(cat photometric/import.cpu) s, $samples samples" \
    "$(calc '%.2f %%' "100*$error")" "flux 0.5 %" "$(holds "$flux < 0.005 && $flux > -0.005")"
done

heading "intensities in 200 directions, 100 openings away, through POV-Ray (asked: 2 and 5 %)"
"$TESTS/chain/test_photometric" | grep within
heading "irradiance half an opening's width away, by import (asked: 3 %)"
"$TESTS/unit/test_photometry_slab" | grep within
