#!/usr/bin/env bats
# bakeslab bake --depend: a rule that make itself takes for what it says.
load bake

setup() {
  bake_setup
  unset MAKEFLAGS MFLAGS MAKELEVEL MAKEOVERRIDES
  printf -- '-include slab.d\nslab.tif:\n\ttouch $@\n' >Makefile
}

@test "each file that the script reads, whatever its name, remakes the slab, and so does its loss" {
  # In the working folder, below it, and elsewhere; by names that mean something to make.
  # shellcheck disable=SC1003
  local names=('a b' 'a#b' 'a\ #b' 'a$(b)c' 'a\b' 'a\\' 'a%b' 'a:b' 'a=b' 'a*b' 'a?b' 'a[b]' '~a' "a'b" 'a&b'
    'sub folder/x.inc' '../els ewhere/x.inc') name
  mkdir -p 'sub folder' '../els ewhere'
  for name in "${names[@]}"; do
    echo '// read' >"$name"
    printf '#include "%s"\n' "$name" >>flat.pov
  done
  small flat.pov -q -o slab.tif --depend early.d --dry-run
  small flat.pov -q -o slab.tif --depend slab.d
  cmp early.d slab.d
  # All that it names is there and older than the slab; a slab made before it is not.
  make -q slab.tif
  touch -d '1 hour ago' flat.pov "${names[@]}"
  for name in flat.pov "${names[@]}"; do
    echo "$name"
    touch -d '1 hour' "$name"
    run -1 make -q slab.tif
    touch -d '1 hour ago' "$name"
    make -q slab.tif
  done
  for name in "${names[@]}"; do
    echo "$name"
    mv "$name" kept
    run -1 make -q slab.tif
    mv kept "$name"
  done
  # The script itself has no such rule.
  rm flat.pov
  run -2 make -q slab.tif
}

@test "the slab's name too; and to standard output" {
  small flat.pov -q -o 'a slab #1.tif' --depend - >slab.d
  sed -i 's/^slab.tif/a\\ slab\\ \\#1.tif/' Makefile
  make -q 'a slab #1.tif'
  touch -d '1 hour' flat.pov
  run -1 make -q 'a slab #1.tif'
}

@test "refused before the work: names that make cannot carry, files that cannot be" {
  local name
  for name in 'a;b' 'a|b' $'a\tb' 'a&' 'a(b)'; do
    echo '// read' >"$name"
    flat_lamp lamp.pov "#include \"$name\""
    refused 1 'make cannot carry the name "a' x.tif small lamp.pov -o x.tif --depend x.d
    [ ! -e x.d ]
  done
  refused 1 'none/x.d: .*No such file' x.tif small flat.pov -o x.tif --depend none/x.d
  refused 1 '--depend flat.pov: is a file that the lamp script reads' x.tif small flat.pov -o x.tif --depend flat.pov
  grep -q Canned_Slab flat.pov
  refused 1 '--depend x.tif: is the slab' x.tif small flat.pov -o x.tif --depend x.tif
  # A bake that fails leaves the rule of the last one that did not.
  small flat.pov -q -o x.tif --depend x.d
  cp x.d old.d
  echo '#include "more.inc"' >>flat.pov
  echo 'sphere { }' >more.inc
  run -1 small flat.pov -o x.tif --depend x.d
  cmp x.d old.d
}
