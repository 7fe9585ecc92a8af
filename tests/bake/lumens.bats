#!/usr/bin/env bats
# Bulbs in lumens and kelvin: what leaves a closed box around one, its colour, and what is refused.
bats_require_minimum_version 1.5.0
load bake

setup() { bake_setup; }

# lamp FILE TEXT: within a cube of six pages, 2 wide, in centimetres.
lamp() {
  printf '%s\n' '#version 3.7;' '#include "canned.inc"' 'Canned_Lamp("bulb") Canned_Needs("")' \
    '#for (I_, 0, 5)
       #local N_ = (I_ < 4 ? vrotate(z, 90*I_*y) : (I_ < 5 ? y : -y));
       #local U_ = (I_ < 4 ? vrotate(2*x, 90*I_*y) : 2*x);
       Canned_Slab(N_, U_, (I_ < 4 ? 2*y : 2*z), N_, <-3, 3, -3, 3>, 0)
     #end' "$2" >"$1"
}

# told FILE: lumens, u' and v' of all pages' flux.
told() {
  "$BAKESLAB" info --json "$1" | tr -d ' \n' | grep -o '"flux":\[[^]]*\]' | tr -d '"flux:[]' | awk -F, '
    { r += $1; g += $2; b += $3 }
    END { x = 0.4124*r + 0.3576*g + 0.1805*b; y = 0.2126*r + 0.7152*g + 0.0722*b; z = 0.0193*r + 0.1192*g + 0.9505*b
      print y, 4*x/(x + 15*y + 3*z), 9*y/(x + 15*y + 3*z) }'
}

# within LUMENS U V: what `told` says is, within 1 % and 0.01 of u', v'.
within() {
  awk -v l="$1" -v u="$2" -v v="$3" '{ print
    exit !($1 > 0.99*l && $1 < 1.01*l && sqrt(($2 - u)^2 + ($3 - v)^2) < 0.01) }'
}

@test "all lumens of a bulb leave a closed box around it, in its colour" {
  lamp warm.pov 'Canned_Metres_Per_Unit(0.01) Canned_Bulb_Lumens(0, 0.5, 806, 2700)'
  bake warm.pov -q -o warm.exr --uv 4 --st 32 --rays 4
  "$BAKESLAB" info warm.exr | grep -q 'cd/m2'
  told warm.exr | within 806 0.2626 0.5283 # Planck's, from (0.4599, 0.4106)
  lamp cold.pov 'Canned_Bulb_Lumens(0, 0.5, 470, 6500)'
  bake cold.pov -q -o cold.exr --uv 2 --st 8 --rays 1
  told cold.exr | awk '{ print; exit !(sqrt(($2 - 0.2)^2 + ($3 - 0.4654)^2) < 0.01) }' # (0.3135, 0.3237)
}

# declines TEXT SCRIPT: the bake stops with this.
declines() {
  lamp bad.pov "$2"
  refuses 1 "$1" -- "$BAKESLAB" bake bad.pov -o bad.exr
}

@test "refused: no lumens, no such colour, other units, too late" {
  declines 'Canned_Bulb_Lumens: 0.000000 lumens' 'Canned_Bulb_Lumens(0, 0.5, 0, 2700)'
  declines 'Canned_Bulb_Lumens: the radius' 'Canned_Bulb_Lumens(0, 0, 800, 2700)'
  declines 'Canned_Bulb_Lumens: 999.0 K is not from 1000 to 40000' 'Canned_Bulb_Lumens(0, 0.5, 800, 999)'
  declines 'Canned_Kelvin: 40001.0 K is not from 1000 to 40000' '#declare C = Canned_Kelvin(40001);'
  declines 'gives cd/m2, but Canned_Radiance_Unit' 'Canned_Radiance_Unit("W/(sr m2)") Canned_Bulb_Lumens(0, 0.5, 800, 2700)'
  declines 'call it before Canned_Bulb_Lumens' 'Canned_Bulb_Lumens(0, 0.5, 800, 2700) Canned_Metres_Per_Unit(0.01)'
}
