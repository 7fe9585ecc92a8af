#!/usr/bin/env bats
# The balance of a lamp's light: efficiency, what the pages miss, more light than there is.
# shellcheck disable=SC2154 # run sets stderr and stderr_lines
bats_require_minimum_version 1.5.0
load bake

setup() { bake_setup; }

# lamp FILE TEXT: without slabs.
lamp() { printf '%s\n' '#version 3.7;' '#include "canned.inc"' 'Canned_Lamp("weighed")' "$2" >"$1"; }
# told FILE KEY: a number of the provenance.
told() { "$BAKESLAB" info --json "$1" | tr -d ' \n' | sed "s/.*\"$2\":\([-0-9.e]*\).*/\1/"; }
# near A B PART: two numbers agree.
near() { awk -v a="$1" -v b="$2" -v p="$3" 'BEGIN { print a, b; exit !(a - b <= p*b && b - a <= p*b) }'; }
# A cube of six pages, 2 wide, around the origin.
cube='Canned_Needs("")
#for (I_, 0, 5)
  #local N_ = (I_ < 4 ? vrotate(z, 90*I_*y) : (I_ < 5 ? y : -y));
  #local U_ = (I_ < 4 ? vrotate(2*x, 90*I_*y) : 2*x);
  Canned_Slab(N_, U_, (I_ < 4 ? 2*y : 2*z), N_, <-W_, W_, -W_, W_>, 0)
#end'

@test "a bare bulb in a box: all of its light leaves, nothing is missed or told" {
  lamp bulb.pov "#declare W_ = 2; $cube Canned_Bulb(0, 0.2, <5, 2, 1>)"
  bake bulb.pov -q -o x.exr --strict --uv 8 --st 32 --rays 16
  near "$(told x.exr efficiency)" 1 0.02
  run "$BAKESLAB" check --strict x.exr
  [ "$status" -eq 0 ]
}

# covers FILE TRUTH: it is within what the told efficiency is known to, of $known percent.
covers() {
  known=$("$BAKESLAB" info "$1" | sed -n 's/.*(known to \([0-9.]*\) % of that).*/\1/p')
  near "$2" "$(told "$1" efficiency)" "$(awk -v k="$known" 'BEGIN { print k/100 }')"
}

@test "few rays find a small bulb, and none on some page: how well the efficiency is known" {
  lamp small.pov 'Canned_Needs("") #declare W_ = <-10, 10, -10, 10>;
    Canned_Slab(<-3, 1, 0>, 8*z, 6*y, -x, W_, 0) Canned_Slab(<5, 1, 0>, 8*z, 6*y, x, W_, 0)
    Canned_Slab(<1, -2, 0>, 8*x, 8*z, -y, W_, 0) Canned_Slab(<1, 4, 0>, 8*x, 8*z, y, W_, 0)
    Canned_Slab(<1, 1, -4>, 8*x, 6*y, -z, W_, 0) Canned_Slab(<1, 1, 4>, 8*x, 6*y, z, W_, 0)
    Canned_Bulb(0, 0.3, 10)'
  local rays
  for rays in 4 16; do # with 16, where the search was lucky is not all that is looked at
    bake small.pov -q -o x.exr --uv 6 --st 24 --rays $rays
    covers x.exr 1
    awk -v k="$known" -v r=$rays 'BEGIN { exit !(k > 10 && k < (r > 4 ? 40 : 90)) }'
  done
}

@test "bulbs in rows, as far apart as positions: neither off nor thought to be" {
  lamp rows.pov 'Canned_Needs("") Canned_Slab(0, 8*x, 8*z, -y, <-4, 4, -4, 4>, 0)
    #for (I_, 1, 8) #for (J_, 1, 8) Canned_Bulb(<I_ - 4.5, 0.5, J_ - 4.5>, 0.1, 10) #end #end'
  bake rows.pov -q -o x.exr --uv 8 --st 24 --rays 4
  # Of each bulb the solid angle of the part of the page that its window shows.
  covers x.exr "$(awk 'function o(x, y) { return atan2(x*y, sqrt(1 + x*x + y*y)) }
    function edge(x) { return x < 4 ? x : 4 }
    BEGIN { for (i = 0.5; i < 8; ++i) for (j = 0.5; j < 8; ++j) for (k = 0; k < 4; ++k)
        sum += o(edge(2*(k % 2 ? i : 8 - i)), edge(2*(k > 1 ? j : 8 - j)))
      print sum/64/(4*3.14159265) }')"
  awk -v k="$known" 'BEGIN { exit !(k < 12) }'
}

@test "windows too narrow for a box: one line, with the light that they miss" {
  # Through a face, seen from its middle, a small bulb shines at slopes up to 1 along u and v.
  lamp bulb.pov "#declare W_ = 0.7; $cube Canned_Bulb(0, 0.1, 5)"
  run --separate-stderr bake bulb.pov -q -o x.exr --uv 8 --st 16 --rays 4
  [ "$status" -eq 0 ]
  [[ ${#stderr_lines[@]} -eq 1 && $stderr == *"the pages miss "*" % of the light"*"beyond their windows"* ]]
  # A face sends a sixth of the light; a square of it, seen from the bulb, corner(0.7)/corner(1).
  local missed
  missed=$(awk 'function c(a) { return atan2(a*a, sqrt(1 + 2*a*a)) } BEGIN { print 1 - c(0.7)/c(1) }')
  near "$(told x.exr missed)" "$missed" 0.15
  run "$BAKESLAB" check x.exr
  [ "$(grep -c warning <<<"$output")" -eq 1 ]
}

@test "a flat box without a page above: what leaves there is told" {
  # The part of a bulb's light that passes a rectangle 10 by 10, 3 away: its solid angle.
  lamp open.pov 'Canned_Needs("") #declare W_ = <-3, 3, -3, 3>;
    #for (I_, 0, 3) Canned_Slab(vrotate(5*z, 90*I_*y), vrotate(10*x, 90*I_*y), 6*y, vrotate(z, 90*I_*y), W_, 0) #end
    Canned_Slab(-3*y, 10*x, 10*z, -y, W_, 0) Canned_Bulb(0, 0.8, 10)'
  bake open.pov -q -o x.exr --uv 4 --st 24 --rays 4
  near "$(told x.exr missed)" "$(awk 'BEGIN { print atan2(25, 3*sqrt(59))/3.14159265 }')" 0.2
  # A lid just there, and nothing leaves.
  echo 'box { <-5, 3, -5>, <5, 3.5, 5> pigment { rgb 0 } }' >>open.pov
  run bake open.pov -q -o y.exr --uv 4 --st 24 --rays 4
  [[ $status -eq 0 && $output != *"the pages miss"* ]]
}

@test "an opening that is tilted: what is inside the lamp is not missed" {
  lamp can.pov '#declare Tilt_ = 25*z; Canned_Needs("interreflection")
    Canned_Slab(0, vrotate(2*x, Tilt_), 2*z, vrotate(-y, Tilt_), <-9, 9, -9, 9>, 0)
    union { cone { 0, 1, 2*y, 0.4 open } disc { 2*y, y, 0.4 } rotate Tilt_
      pigment { rgb 0.8 } finish { diffuse 1 } }
    Canned_Bulb(vrotate(y, Tilt_), 0.3, 5)'
  run bake can.pov -q -o x.exr --uv 4 --st 16 --rays 4
  [[ $status -eq 0 && $output != *"the pages miss"* ]] || { echo "$output"; return 1; }
  # Nor in the upper one of two.
  lamp two.pov 'Canned_Needs("interreflection")
    #for (I_, 0, 1)
      Canned_Slab(<3*I_, I_, 0>, 2*x, 2*z, -y, <-9, 9, -9, 9>, 0)
      union { cone { 0, 1, 2*y, 0.4 open } disc { 2*y, y, 0.4 } translate <3*I_, I_, 0>
        pigment { rgb 0.8 } finish { diffuse 1 } }
      Canned_Bulb(<3*I_, I_ + 1, 0>, 0.3, 5)
    #end'
  run bake two.pov -q -o x.exr --uv 4 --st 16 --rays 4
  [[ $status -eq 0 && $output != *"the pages miss"* ]] || { echo "$output"; return 1; }
}

@test "a glowing disc: Lambert's law says how much a window lets through" {
  lamp disc.pov 'Canned_Needs("") Canned_Metres_Per_Unit(0.5) Canned_Radiance_Unit("W/(sr m2)")
    Canned_Slab(0, 2*x, 2*y, z, <-1, 1, -1, 1>, 0)
    disc { -0.001*z, z, 0.7 pigment { rgb 1 } finish { emission 3 } }'
  run --separate-stderr bake disc.pov -q -o x.exr --uv 16 --st 16 --rays 4
  [[ $("$BAKESLAB" info x.exr) == *"energy "*"efficiency not known: nothing in the script tells the flux"* ]]
  near "$(told x.exr missed)" 0.4459 0.1
  sed -i '1,/Canned_Needs/s/Canned_Needs("")/& Canned_Glow(pi*0.7*0.7, 3)/' disc.pov
  bake disc.pov -q -o y.exr --uv 16 --st 16 --rays 4
  near "$(told y.exr efficiency)" 0.5541 0.02
  [[ $("$BAKESLAB" info y.exr) == *"of 3.627 W that the sources give, "*" leaves through the pages: efficiency 5"* ]]
  # A bulb beside it: what glows by itself is told from the bulb's light.
  sed 's/Canned_Glow([^)]*)/Canned_Bulb(<0.9, 0, -0.1>, 0.05, 5)/' disc.pov >both.pov
  bake both.pov -q -o z.exr --uv 16 --st 16 --rays 4
  [[ $("$BAKESLAB" info z.exr) == *"% not of bulbs); efficiency not known: there is more light than Canned_Bulb's"* ]]
}

@test "photons through a translucent surface: more light than the bulb gives" {
  lamp opal.pov 'Canned_Slab(4*z, 10*x, 10*y, z, <-4, 4, -4, 4>, 0)
    Canned_Bulb(0.1*z, 0.2, 100)
    lathe { linear_spline 21, #for (I_, 0, 20) <I_*0.25, pow(I_*0.25, 2)/5 - 1.3> #end
      rotate 90*x pigment { rgb 0 } finish { diffuse 0 reflection 0.95 }
      photons { target reflection on refraction off } }
    disc { 3.9*z, z, 5 pigment { rgb 1 } finish { diffuse 0.1, 0.8 } }'
  run --separate-stderr bake opal.pov -q -o x.exr --uv 4 --st 16 --rays 4 --effects caustics
  echo "$status $stderr"
  [ "$status" -eq 0 ]
  [[ $stderr == *"times as much light leaves the lamp as its bulbs give; POV-Ray shows photons"* ]]
  run --separate-stderr bake opal.pov -q -o y.exr --uv 4 --st 16 --rays 4 --effects caustics --strict
  [ "$status" -eq 1 ] && [ ! -e y.exr ]
}

@test "highlights are left out, and nothing else" {
  shiny() {
    lamp "$1.pov" "Canned_Needs(\"\") Canned_Slab(<0, 0, 0>, 2*x, 2*y, z, <-1, 1, -1, 1>, 0)
      Canned_Bulb(-1*z, 0.1, 5)
      #declare Shiny_ = finish { diffuse 0.5 $2 /* } */ } // finish {
      #declare Name_ = \"finish { specular 1\";
      #macro Half_() finish { diffuse 0.3 #end
      sphere { <0.5, 0, -2>, 0.6 pigment { rgb 1 } finish { Shiny_ } }
      box { <-1, -1, -3>, <1, 1, -2.9> pigment { rgb 0.7 } finish { diffuse 0.4 #ifdef (Name_) $2 #end } }
      sphere { <-0.5, 0, -2>, 0.4 pigment { rgb 1 } Half_() } }"
    bake "$1.pov" -o "$1.exr" --uv 4 --st 16 --rays 4 2>"$1.txt"
  }
  shiny bright 'specular 0.5 roughness 0.1'
  shiny dull ''
  grep -q 'bright.pov: note: highlights (specular, phong) are no light, and are left out' bright.txt
  run -1 grep 'note: highlights' dull.txt
  same bright.exr dull.exr
}

@test "the plan first: --dry-run tells and stops; a name that no include can bear is refused" {
  run -0 --separate-stderr bake flat.pov -o x.tif --uv 4x5 --st 6 --rays 8 --dry-run
  [[ $stderr == *"flat.pov: plan: 1 page of 4 x 5 x 6 x 6 samples"*"; 5.76e+03 rays; time some "*" s with "*" jobs, memory "*" MB, file "*" MB" ]]
  [ ! -e x.tif ]
  # Again, from the small bakes that the first one kept.
  run -0 --separate-stderr bake flat.pov -o x.tif --uv 256 --st 128 --rays 1024 --dry-run
  [[ $stderr == *"; time some "*" h with "* ]]
  # The file's size, of a lamp that is dark beside its beam, packed well, and of a noisy one.
  local lamp told
  printf '#version 3.7;\n#include "canned.inc"\nCanned_Lamp("noisy") Canned_Needs("")
    Canned_Slab(0, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
    plane { z, -2 pigment { bozo scale 0.01 color_map { [0 rgb 0] [1 rgb 9] } } finish { emission 1 } }' >noisy.pov
  sed 's/plane .*/sphere { -9*z, 1 pigment { rgb 1 } finish { emission 1 } }/' noisy.pov >dark.pov
  for lamp in noisy dark; do
    told=$("$BAKESLAB" bake $lamp.pov -o $lamp.tif --uv 8 --st 32 --rays 4 --dry-run 2>&1 | sed -n 's/.*, file \(.*\) MB/\1/p')
    bake $lamp.pov -q -o $lamp.tif --uv 8 --st 32 --rays 4
    echo "$lamp $told $(wc -c <$lamp.tif)"
    awk -v told="$told" -v bytes="$(wc -c <$lamp.tif)" 'BEGIN { ratio = told*1e6/bytes; exit !(ratio > 0.5 && ratio < 2) }'
  done
  sed 's/"flat"/"7 flat"/' flat.pov >name.pov
  refused 1 'name.pov: Canned_Lamp: ' x.exr bake name.pov -o x.exr --uv 2 --st 4
}
