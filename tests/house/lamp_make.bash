# A scratch folder of lamps and pictures, and make there with an installed canned.mk.
# shellcheck shell=bash

lamp_make_setup() {
  cd "$BATS_TEST_TMPDIR" || return 1
  unset BAKESLAB CANNED_INCLUDE
  PATH=$PREFIX/bin:$PATH
  echo '#declare Glow = 0.5;' >glow.inc
  some_lamp desk_lamp '#include "glow.inc"'
  some_lamp torch '#declare Glow = 1;'
}

# some_lamp PATH [TEXT]: PATH.pov, a wall that glows behind an aperture.
some_lamp() {
  cat >"$1.pov" <<END
#version 3.7;
#include "canned.inc"
${2-}
Canned_Lamp("$(basename "$1" | tr -c 'a-z_\n' _)")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
box { <-50, -50, -1.1>, <50, 50, -1> pigment { rgb 1 } finish { emission Glow diffuse 0 } }
END
}

# A Makefile that includes the installed canned.mk, and more lines from stdin.
a_makefile() {
  {
    echo "include $PREFIX/share/canned/canned.mk"
    echo 'CANNED_BAKE_FLAGS = --uv 2 --st 4 --rays 4'
    cat
  } >Makefile
}

# make as a user calls it.
lamp_make() { env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u MAKEOVERRIDES make "$@"; }
