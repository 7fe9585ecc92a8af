#!/usr/bin/env bash
# What `make elsewhere` does: the room of include-pov, lit by one slab alone (no light goes from
# surface to surface), as five programs draw it with what bakeslab makes for them, on one thread each but Mitsuba.
# Pictures and seconds stay in $BUILD: a run that is interrupted goes on from there.
set -euo pipefail
# shellcheck source=tests/tradeoff/tradeoff.bash disable=SC2154
. "$(dirname "$0")/../tradeoff/tradeoff.bash"
# shellcheck source=tests/peers/engines.bash disable=SC2154
. "$root/tests/peers/engines.bash"
room=$root/tests/elsewhere
SAMPLES=${SAMPLES:-256} # rays a pixel of those that draw rays by chance; each draws two pictures

# by WAY COMMAND...: the command prints its CPU seconds. A way that fails is a row that says why.
by() {
  local way=$1
  shift
  [ ! -f "$way.cpu" ] || return 0
  echo "$way" >&2
  rm -f "$way.absent"
  if "$@" >"$way.new" 2>"$way.log"; then
    mv "$way.new" "$way.cpu"
  else
    { grep -v '^ ' "$way.log" || true; } | tail -n 1 >"$way.absent"
    echo "run.sh: $way: $(cat "$way.absent")" >&2
  fi
}

# Twice the pixels along each axis; report.py takes means of four.
fine=480x360

by_renderslab() {
  cpu_of renderslab.seconds "$RENDERSLAB" image room.obj "${light[@]}" --size "$fine" --threads 1 -q -o renderslab.exr || return
  plain renderslab.exr renderslab-1.exr || return
  cat renderslab.seconds
}

by_povray() {
  "$BAKESLAB" include desk_lamp.tif -o desk_lamp.inc -q || return
  "$RENDERSLAB" pov room.obj "${light[@]}" --size "$fine" -q -o povray.pov || return
  cpu_of povray.seconds povray +Ipovray.pov +Opovray.exr "+W${fine%x*}" "+H${fine#*x}" +FE -A -D +WT1 || return
  plain povray.exr povray-1.exr || return
  cat povray.seconds
}

by_radiance() {
  local options view place
  engine_radiance || { echo 'Radiance is neither in this Debian nor as pyradiance on PyPI' >&2; return 1; }
  "$BAKESLAB" export desk_lamp.tif -o radiance --as radiance -q --force || return
  read -ra options <<<"$(grep -om 1 -e '-ds .*-dc 1' radiance/desk_lamp.rad)"
  read -ra view <<<"$("$numpy" "$room/room.py" view)"
  read -ra place <<<"$("$numpy" "$room/room.py" place)"
  "$numpy" "$room/room.py" radiance >radiance/room.rad
  (cd radiance && xform "${place[@]}" desk_lamp.rad >placed.rad && oconv room.rad placed.rad >room.oct &&
    vwrays -ff -x "${fine%x*}" -y "${fine#*x}" "${view[@]}" >rays) || return
  # shellcheck disable=SC2016 # for the shell inside
  cpu_of radiance.seconds env -C radiance bash -c 'rtrace -h -w- -ff -ab 0 -av 0 0 0 "$@" room.oct <rays >picture' - "${options[@]}" || return
  "$numpy" "$room/room.py" picture radiance/picture "$fine" radiance-1.pfm || return
  cat radiance.seconds
}

by_mitsuba() {
  engine_mitsuba rgb || { echo 'pip cannot install mitsuba' >&2; return 1; }
  "$BAKESLAB" export desk_lamp.tif -o mitsuba --as mitsuba -q --force || return
  "$mitsuba_python" "$room/mitsuba_picture.py" mitsuba desk_lamp "$SAMPLES" 1 mitsuba-1.pfm &&
    "$mitsuba_python" "$room/mitsuba_picture.py" mitsuba desk_lamp "$SAMPLES" 2 mitsuba-2.pfm >/dev/null
}

by_cycles() {
  engine_blender || { echo 'pip cannot install bpy' >&2; return 1; }
  "$BAKESLAB" export desk_lamp.tif -o cycles --as cycles -q --force || return
  "$blender_python" "$room/blender_picture.py" cycles desk_lamp "$SAMPLES" 1 cycles-1.pfm &&
    "$blender_python" "$room/blender_picture.py" cycles desk_lamp "$SAMPLES" 2 cycles-2.pfm >/dev/null
}

engine_python venv numpy numpy || { echo 'run.sh: pip cannot install numpy' >&2; exit 1; }
numpy=$ENGINES/venv/bin/python
export PYTHONDONTWRITEBYTECODE=1
[ -f desk_lamp.tif ] || "$BAKESLAB" bake "$root/lamps/desk_lamp.pov" -o desk_lamp.tif --uv 16x16 --st 64x64 --yes
"$numpy" "$room/room.py" mesh room.obj
cp "$root/include-pov/room.mtl" .
light=(--light "desk_lamp.tif $("$numpy" "$room/room.py" light)" --camera "$("$numpy" "$room/room.py" camera)")
by povray by_povray
by renderslab by_renderslab
by cycles by_cycles
by radiance by_radiance
by mitsuba by_mitsuba
"$numpy" "$room/report.py"
