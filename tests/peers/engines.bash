# engines.bash - other renderers, from PyPI and Debian, in the scratch folder $ENGINES: Mitsuba 3 and
# Radiance in venv, in the versions that were measured; Blender's module bpy, which asks for a numpy
# of its own, in bpy. Needs the network once. Sourced; errors of pip go to $ENGINES/*.log. pip has
# ENGINE_SECONDS (900) for each.
# shellcheck shell=bash
: "${ENGINES:?is the folder for them}"
mkdir -p "$ENGINES"
# shellcheck disable=SC2034 # for those who source this
mitsuba_python=$ENGINES/venv/bin/python blender_python=$ENGINES/bpy/bin/python

# engine_python VENV MODULE PACKAGE...: a python3 that has the module, installed if need be.
engine_python() {
  local venv=$ENGINES/$1 module=$2
  shift 2
  if [ ! -x "$venv/bin/python" ] && ! python3 -m venv "$venv" >"$venv.log" 2>&1; then
    echo 'engines.bash: python3 -m venv does not work here; the Debian package is python3-venv' >&2
    return 1
  fi
  "$venv/bin/python" -c "import $module" 2>/dev/null && return
  timeout "${ENGINE_SECONDS:-900}" "$venv/bin/python" -m pip install -q --retries 1 --timeout 15 "$@" >"$venv-$module.log" 2>&1 &&
    "$venv/bin/python" -c "import $module" 2>>"$venv-$module.log" && return
  rm -rf -- "$venv"/lib/python3*/site-packages/"$module" # half of it is none
  return 1
}

# Mitsuba's fast variants compile by LLVM, newer than the default of Debian 12; engine_mitsuba KIND
# names the variant llvm_ad_KIND in MITSUBA_VARIANT where that is at hand, else scalar_rgb, as without
# a KIND.
engine_mitsuba() {
  local llvm=$ENGINES/debian/usr/lib/x86_64-linux-gnu/libLLVM-19.so
  engine_python venv mitsuba mitsuba==3.9.1 numpy || return
  [ -n "${1-}" ] || return 0
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
  engine_python venv pyradiance pyradiance==1.3.1 || return
  radiance=$(echo "$ENGINES"/venv/lib/python3*/site-packages/pyradiance)
  [ -d "$radiance/bin" ] || return
  export PATH=$radiance/bin:$PATH RAYPATH=.:$radiance/lib
}

# The newest Blender that this python3 can have, without a window.
engine_blender() { engine_python bpy bpy bpy; }

# engines_install ENGINE...: radiance, mitsuba (rays alone), llvm (Mitsuba's samples), blender.
engines_install() {
  local engine missing=
  for engine; do
    case $engine in
      llvm) engine_mitsuba rgb && [ "$MITSUBA_VARIANT" != scalar_rgb ] ;;
      *) "engine_$engine" ;;
    esac || missing+=", $engine"
  done
  [ -z "$missing" ] || echo "not installed: ${missing#, }; their rays are skipped ($ENGINES/*.log tell why)"
}
