#!/usr/bin/env bats
# Everything that a bake must refuse: one clear line, exit 1 or 2, no output and
# no store left behind.
load bake

setup() { bake_setup; }

# spoilt PATTERN EDIT: refused so where sed's EDIT is made to the lamp.
spoilt() {
  sed "$2" flat.pov >lamp.pov
  refused 1 "$1" x.tif bake lamp.pov -o x.tif
}

# declared PATTERN TEXT: refused so where the lamp says this too.
declared() {
  flat_lamp lamp.pov "$2"
  refused 1 "$1" x.tif bake lamp.pov -o x.tif
}

@test "a script that is missing, or is a folder" {
  refused 1 'none.pov: No such file' x.tif bake none.pov -o x.tif
  mkdir folder.pov
  refused 1 'folder.pov: .*not a file' x.tif bake folder.pov -o x.tif
}

@test "a script that does not parse: POV-Ray's line with the user's file and line" {
  declared "'lamp.pov' line 7: .*Parse Error" 'sphere { <0, 0, 0> }'
  declared "At the end of 'lamp.pov': Parse Error: No matching }" 'sphere { <0, 0, 0>, 1 pigment { rgb 1 }'
  declared "At the end of 'lamp.pov': Parse Error: .*#end expected" '#if (1)'
  mkdir sub
  printf '\n\nbox { oops }\n' >sub/parts.inc
  flat_lamp sub/broken.pov '#include "parts.inc"'
  refused 1 "/sub/parts.inc' line 3: .*oops" x.tif bake sub/broken.pov -o x.tif
  declared 'nowhere.inc' '#include "nowhere.inc"'
  declared 'The shade is too small' '#error "The shade is too small\n"'
}

@test "a picture that is missing, beside lines that look like errors: POV-Ray's reason" {
  flat_lamp broken.pov '#warning "Fatal error in parser: not at all\n"
box { 0, 1 pigment { image_map { png "nothing.png" } } }'
  refused 1 "'broken.pov' line 8: Cannot find file 'nothing.png'.*Cannot open file" x.tif bake broken.pov -o x.tif
  # One that cannot be read is named too.
  echo none >nothing.png
  refused 1 "broken.pov.*PNG" x.tif bake broken.pov -o x.tif
}

@test "a script that includes itself, takes all memory, writes or runs without end" {
  flat_lamp again.pov '#include "again.pov"'
  refused 1 "again.pov' line [27]: Parse Error: Too many nested include" x.tif small again.pov -o x.tif
  flat_lamp endless.pov '#while (1) #end'
  refused 1 'endless.pov: not done within --timeout 1: interrupted while (POV-Ray was trying the script|povray was asked)' x.tif \
    small endless.pov -o x.tif --timeout 1
  printf '#!/bin/sh\nexec sleep 1000\n' >hangs
  printf '#!/bin/sh\n[ "$1" = --version ] && exec povray "$@"\nkill -ABRT $$\n' >crashes
  chmod +x hangs crashes
  refused 1 'flat.pov: not done within --timeout 1: interrupted while .*hangs was asked' x.tif \
    small flat.pov -o x.tif --timeout 1 --povray ./hangs
  refused 1 'flat.pov: POV-Ray was killed by signal 6' x.tif small flat.pov -o x.tif --povray ./crashes
  flat_lamp writes.pov "#fopen F \"long.txt\" write
#declare Line = \"0123456789012345678901234567890123456789012345678901234567890123456789\";
#for (K, 1, 4) #declare Line = concat(Line, Line, Line, Line); #end
#while (1) #write (F, Line) #end"
  (
    ulimit -f 8192
    refused 1 'writes.pov: POV-Ray wrote a file of more than 8 MiB' x.tif small writes.pov -o x.tif
  )
  [ "$CONFIG" = sanitize ] && skip 'sanitisers need all address space'
  flat_lamp greedy.pov '#declare Many = array[300000000];'
  (
    ulimit -v 1000000
    refused 1 'greedy.pov: POV-Ray needs more than 0.95 GiB of memory .*line 7' x.tif small greedy.pov -o x.tif
  )
}

@test "what a script prints is not kept" {
  flat_lamp chatty.pov '#for (K, 1, 20000) #debug concat(str(K, 0, 0), " bottles of beer\n") #end'
  small chatty.pov -q -o x.exr
}

@test "a script without a slab, without a name, without canned.inc" {
  spoilt 'lamp.pov: declares no slab; .*Canned_Slab' /Canned_Slab/d
  spoilt 'lamp.pov: has no name; .*Canned_Lamp' /Canned_Lamp/d
  spoilt 'Canned_Lamp: the name is empty' 's/"flat"/""/'
  spoilt 'lamp.pov: declares no slab' '/box/!d'
  spoilt 'lamp.pov: declares no slab' d
}

@test "frames and windows that are none" {
  spoilt 'Canned_Slab: u = .*not perpendicular to v = <0.5' 's/<0, 2, 0>/<0.5, 2, 0>/'
  spoilt 'Canned_Slab: the normal .*not perpendicular' 's/<0, 0, 1>/<0, 0.3, 1>/'
  spoilt 'Canned_Slab: the normal has no length' 's/<0, 0, 1>/<0, 0, 0>/'
  spoilt 'Canned_Slab: an edge vector has no length' 's/<2, 0, 0>/<0, 0, 0>/'
  spoilt 'Canned_Slab: the st window .*is empty' 's/<-1, 1, -1, 1>/<-1, 1, 1, 1>/'
  spoilt 'Canned_Slab: the st distance .*negative' 's/, 0)/, -3)/'
}

@test "words that are no effects, and units that are none" {
  refused 1 'effects: "shine" is no effect' x.tif bake flat.pov -o x.tif --effects caustics,shine
  refused 1 'effects: "caustics=0": no whole number' x.tif bake flat.pov -o x.tif --effects deep_trace,caustics=0
  refused 1 '"caustics=4x": no whole' x.tif bake flat.pov -o x.tif --effects caustics=4x
  spoilt 'Canned_Needs: "sparkle" is none of' 's/Needs(""/Needs("caustics sparkle"/'
  declared 'Canned_Radiance_Unit: "lm" is none of' 'Canned_Radiance_Unit("lm")'
  declared 'Canned_Metres_Per_Unit: 0.* is not greater than 0' 'Canned_Metres_Per_Unit(0)'
  declared 'Canned_Bulb: the radius 0.* is not greater than 0' 'Canned_Bulb(<0, 0, -0.5>, 0, 1)'
}

@test "POV-Ray missing, another program, another version, a broken one" {
  refused 1 '/nonexistent: cannot be run .No such file.*; install POV-Ray' x.tif \
    bake flat.pov -o x.tif --povray /nonexistent
  refused 1 'true: does not say that it is POV-Ray' x.tif bake flat.pov -o x.tif --povray true
  # one that does not start is asked again, and told with its reason
  printf '#!/bin/sh\necho asked >>asked\necho "Timed out waiting" >&2\nexit 1\n' >late
  chmod +x late
  refused 1 'POV-Ray 3.7 .Timed out waiting.; name' x.tif bake flat.pov -o x.tif --povray ./late
  [ "$(wc -l <asked)" = 3 ]
  printf '#!/bin/sh\necho "POV-Ray 3.6.1" >&2\n' >old
  printf '#!/bin/sh\ncase $1 in --version) povray --version 2>&1;; *) exit 0;; esac\n' >idle
  printf '#!/bin/sh\ncase $1 in --version) povray --version 2>&1;; *) kill -SEGV $$;; esac\n' >crash
  chmod +x old idle crash
  refused 1 'old: is POV-Ray 3.6.1' x.tif bake flat.pov -o x.tif --povray ./old
  refused 1 '.' x.tif bake flat.pov -o x.tif --povray ./idle
  refused 1 'killed by signal 11' x.tif bake flat.pov -o x.tif --povray ./crash
}

@test "outputs that cannot be" {
  : >file
  mkdir folder.tif
  refused 1 'none/x.tif.*: .*No such file' none/x.tif bake flat.pov -o none/x.tif
  refused 1 'file/x.tif.*: .*Not a directory' file/x.tif bake flat.pov -o file/x.tif
  refused 1 'x.png: the name must end in' x.png bake flat.pov -o x.png
  refused 1 'lamp: the name must end in' lamp bake flat.pov -o lamp
  refused 1 'folder.tif: .*not a regular file' '' bake flat.pov -o folder.tif
  [ ! -e folder.tif.partial ]
  refused 1 'EXR cannot hold LogLuv' x.exr bake flat.pov -o x.exr --precision logluv
  : >x.tif.partial
  refused 1 'x.tif.partial: cannot make this folder' '' bake flat.pov -o x.tif
  [ ! -e x.tif ]
}

@test "arguments that are none: exit 2" {
  local bad
  for bad in '--uv 0' '--uv 4x' '--st 5x' '--st x5' '--st -3' '--uv 4x4x4' '--shard 3/2' '--shard 0/2' \
    '--shard 1' '--gain 3' '--gain 0' '--gain 2^' '--gain -2' '--gain nan' '--rays 0' '--rays -2' \
    '--rays 3' '--rays x' '--rays-max 2' '--rays 4 --rays-max 7' '--jobs 0' '--precision double' \
    '--camera fisheye' '--centre --rays 4' 'flat.pov' '--frobnicate'; do
    # shellcheck disable=SC2086
    refused 2 '.' x.tif bake flat.pov -o x.tif $bad
  done
  refused 2 'give a lamp script' x.tif bake -o x.tif
  refused 2 'give -o' '' bake flat.pov
}

@test "radiance that overflows" {
  flat_lamp lamp.pov 'sphere { <0, 0, -0.9>, 0.05 pigment { rgb 1 } finish { emission 60000 diffuse 0 } }'
  run -1 small lamp.pov -o x.tif --st 16 --gain 16
  echo "$output"
  [[ $output == "bakeslab: lamp.pov: page 1, sample ("*"): POV-Ray rendered an infinite radiance;"*"smaller --gain" ]]
  [ ! -e x.tif ]
  [ ! -e x.tif.partial ]
  small lamp.pov -q -o x.tif --st 16
  # Negative radiance is none for LogLuv; the batches are kept for a run that can.
  sed 's/emission 0.5/emission -0.5/' flat.pov >lamp.pov
  run -1 small lamp.pov -o n.tif
  echo "$output"
  [[ $output == *"--precision float"* ]]
  [ ! -e n.tif ]
  run -0 small lamp.pov -o n.tif --precision float
  [[ $output == *"1 batches, 1 of them found"* ]]
}

@test "photons that shot nothing" {
  local bulb='Canned_Bulb(<0, 0, -0.5>, 0.05, 100)'
  sed 's/Needs(""/Needs("caustics"/' flat.pov >lamp.pov
  echo "$bulb" >>lamp.pov
  refused 1 'lamp.pov: caustics: POV-Ray shot 0 photons' x.tif small lamp.pov -o x.tif
  # A target whose centre is the bulb's: POV-Ray shoots 5.
  echo 'sphere { <0, 0, -0.5>, 0.2 pigment { rgbf 1 } interior { ior 1.5 } photons { target refraction on } }' >>lamp.pov
  refused 1 'caustics: POV-Ray shot' x.tif small lamp.pov -o x.tif
  # From an extended source they start beside its centre.
  small lamp.pov -q -o x.tif --effects all
}

@test "a POV-Ray whose threads start late is started again, and told where they never do" {
  cat >late <<'LATE'
#!/bin/sh
[ "$1" = --version ] && exec povray "$@"
mktemp -p "$STARTS" >/dev/null
[ $(($(ls "$STARTS" | wc -l) % 3)) = "$TURN" ] && exec povray "$@"
echo 'Timed out waiting for worker thread startup' >&2
exit 1
LATE
  chmod +x late
  mkdir starts
  small flat.pov -o right.tif --jobs 1
  STARTS=$PWD/starts TURN=0 small flat.pov -o x.tif --jobs 1 --povray ./late
  same x.tif right.tif
  [ "$(find starts -type f | wc -l)" -ge 6 ] # the trial run's three, and three a batch
  rm -r x.tif starts/*
  STARTS=$PWD/starts TURN=3 refused 1 'flat.pov: POV-Ray: Timed out waiting' x.tif \
    small flat.pov -o x.tif --povray ./late
  [ "$(find starts -type f | wc -l)" = 3 ]
}
