#!/usr/bin/env bats
# Rays as the noise calls for them, and windows as the light does.
# shellcheck disable=SC2154 # run sets stderr
load bake

setup() {
  bake_setup
  # A disc behind the aperture, and nothing else: it lights a small part of the window.
  cat >disc.pov <<'LAMP'
#version 3.7;
#include "canned.inc"
Canned_Lamp("disc")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, 2*x, 2*y, z, <-3, 3, -3, 3>, 0)
disc { -4*z, z, 1.3 pigment { rgb 1 } finish { emission 1 diffuse 0 } }
LAMP
}

# holds EXPRESSION: of numbers.
holds() { awk "BEGIN { exit !($1) }" || { echo "not so: $1"; return 1; }; }

# number KEY FILE: of a line of info.
number() { "$BAKESLAB" info "$2" | awk -v key="$1" '$1 == key { print $2 }'; }

# told FILE: the noise of irradiance 4 apertures away, in %.
told() { "$BAKESLAB" check --error "$1" | sed -n 's/.*at 4 apertures.*noise \([0-9.]*\) %.*/\1/p'; }

@test "--noise: what the slab tells is what was asked for, and costs no more rays than that" {
  local noise before=0
  for noise in 0.04 0.02 0.01; do
    "$BAKESLAB" bake disc.pov -q -o x.tif --uv 6 --st 24 --noise $noise
    holds "$(told x.tif) <= 130*$noise && $(told x.tif) >= 60*$noise"
    holds "$(number rays x.tif) > 1.5*$before"
    before=$(number rays x.tif)
  done
}

@test "a window much wider than the light is narrowed, and no light is lost" {
  "$BAKESLAB" bake disc.pov -q -o narrow.tif --uv 16 --st 24
  "$BAKESLAB" bake disc.pov -q -o declared.tif --uv 16 --st 24 --window declared
  [ "$("$BAKESLAB" info declared.tif | grep -c 'st window *-3 3 x -3 3')" = 1 ]
  holds "$("$BAKESLAB" info narrow.tif | awk '/st window/ { print $4 - $3 }') < 2"
  holds "$("$BAKESLAB" info narrow.tif | awk '/st window/ { print $4 - $3 }') > 2*1.3/4"
  # L dA dA' z^2/r^4 over the aperture and the disc, by the middles of small parts.
  local flux
  flux=$(awk 'BEGIN { n = 20; for (i = 0; i < n; ++i) for (j = 0; j < n; ++j)
    for (k = 0; k < n; ++k) for (l = 0; l < n; ++l) { r = 1.3*sqrt((k + 0.5)/n); a = 6.283185307*l/n
      x = (2*i + 1)/n - 1 - r*cos(a); y = (2*j + 1)/n - 1 - r*sin(a); sum += 16/(16 + x*x + y*y)^2 }
    print sum*4*3.14159265*1.69/n^4 }')
  holds "$(number flux narrow.tif)/$flux < 1.01 && $(number flux narrow.tif)/$flux > 0.99"
}

@test "a slab above its tolerance says so, and what may reach it" {
  run -0 --separate-stderr "$BAKESLAB" bake disc.pov -o x.tif --tolerance 0.001 --uv 6 --st 12
  [[ $stderr == *"warning: the slab's own error is about "*", not the tolerance of 0.001: with 6 positions and 12 directions"*"; --uv "*" --st "*" may reach the tolerance"* ]]
}
