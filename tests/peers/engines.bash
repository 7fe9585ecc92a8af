# engines.bash - other renderers, from PyPI and Debian, in the scratch folder $ENGINES: Mitsuba 3 and
# Radiance in venv, Blender's module bpy, which asks for a numpy of its own, in bpy. Needs the
# network once. Sourced; errors of pip go to $ENGINES/*.log.
# shellcheck shell=bash
: "${ENGINES:?is the folder for them}"
mkdir -p "$ENGINES"
# shellcheck disable=SC2034 # for those who source this
mitsuba_python=$ENGINES/venv/bin/python blender_python=$ENGINES/bpy/bin/python

# engine_python VENV MODULE PACKAGE...: a python3 that has the module, installed if need be.
engine_python() {
  local venv=$ENGINES/$1 module=$2
  shift 2
  if [ ! -x "$venv/bin/python" ] && ! python3 -m venv "$venv" >&2; then
    echo 'engines.bash: python3 -m venv does not work here; the Debian package is python3-venv' >&2
    return 1
  fi
  "$venv/bin/python" -c "import $module" 2>/dev/null && return
  "$venv/bin/python" -m pip install -q "$@" >"$venv-$module.log" 2>&1 && "$venv/bin/python" -c "import $module" 2>>"$venv-$module.log"
}

# Mitsuba's fast variants compile by LLVM, newer than the default of Debian 12; engine_mitsuba KIND
# names the variant llvm_ad_KIND in MITSUBA_VARIANT where that is at hand, else scalar_rgb.
engine_mitsuba() {
  local llvm=$ENGINES/debian/usr/lib/x86_64-linux-gnu/libLLVM-19.so
  engine_python venv mitsuba mitsuba numpy || return
  [ -e "$llvm" ] || {
    mkdir -p "$ENGINES/debian"
    (cd "$ENGINES/debian" && apt-get -q download libllvm19 && dpkg -x libllvm19_*.deb .) >"$ENGINES/debian.log" 2>&1 || true
  }
  export MITSUBA_VARIANT=scalar_rgb
  [ ! -e "$llvm" ] || export MITSUBA_VARIANT=llvm_ad_$1 DRJIT_LIBLLVM_PATH=$llvm
}

# Radiance from Debian, where it has it, else as PyPI has it: on the PATH.
engine_radiance() {
  local radiance
  command -v rtrace >/dev/null && return
  engine_python venv pyradiance pyradiance || return
  radiance=$(echo "$ENGINES"/venv/lib/python3*/site-packages/pyradiance)
  [ -d "$radiance/bin" ] || return
  export PATH=$radiance/bin:$PATH RAYPATH=.:$radiance/lib
}

# The newest Blender that this python3 can have, without a window.
engine_blender() { engine_python bpy bpy bpy; }
