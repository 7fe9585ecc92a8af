#!/usr/bin/env bash
# What `make peers` does: the CPU seconds that Mitsuba 3, Radiance, POV-Ray and this project take
# to a picture of a floor under a lamp that errs by 5 % and by 2 %. One thread each.
#   run.sh              everything that is not in $BUILD yet; then the table and the plot
#   run.sh LAMP WAY     one way (below) only, without table and plot
# What is measured is kept in $BUILD/rows, a file each with the picture beside it: a run that is
# interrupted goes on from there.
set -euo pipefail
# shellcheck source=tests/tradeoff/tradeoff.bash disable=SC2154
. "$(dirname "$0")/../tradeoff/tradeoff.bash"
# shellcheck source=tests/peers/engines.bash disable=SC2154
. "$root/tests/peers/engines.bash"
peers=$root/tests/peers

# ---- What is tried. Rays a pixel of light tracing and path tracing, each RUNS times.
RUNS=${RUNS:-3}
TRUTH=${TRUTH:-8192} # rays a pixel of each half of the truth
# One setting a line. light, path: rays a pixel; photons: thousands of them - how many a look-up;
# mkillum: pieces of the aperture a side - directions - rays; lamp, the whole lamp in POV-Ray: rays
# a gathering point; bake: from cheap to dear.
declare -A tried=(
  [light]=$'64\n256'
  [path]=$'64\n256'
  [photons]=$'200-50\n1000-50\n1000-500'
  [mkillum]=$'4-128-32\n8-512-64'
  [lamp parabolic]=$'400\n1600'
  [bake parabolic]=$'--uv 12 --st 48\n--uv 12 --st 48 --effects interreflection=5\n--uv 16 --st 64 --effects interreflection=5'
  [bake headlight]=$'--uv 9x6 --st 96x48\n--uv 18x12 --st 128x64\n--uv 18x12 --st 256x128'
)
samples=3 # renderslab image --samples: the truth's pixels are means
includes=(16 8)
# mkillum is not among them: as radiance_peer.py calls it, its picture is black. Nor is the headlight
# in POV-Ray: its bulbs light the floor by way of mirrors only, by photons, and these come out 27
# times too bright.
ways=(light path photons lamp renderslab include)

python=$mitsuba_python
mkdir -p rows

# absent WAY REASON: a row that says so.
absent() { printf '%s\n' "$2" >"rows/$1.absent"; }

set_up() {
  engine_mitsuba mono || {
    echo 'run.sh: pip cannot install mitsuba, whose light tracing is the truth here' >&2
    exit 1
  }
  engine_radiance || for way in photons mkillum; do
    absent "$way" 'Radiance is neither in this Debian nor as pyradiance on PyPI'
  done
  [ -f versions ] || {
    "$python" -m pip list 2>/dev/null | awk '/^(mitsuba|pyradiance)/ { print $1, $2 }'
    echo "Mitsuba's variant $MITSUBA_VARIANT"
    rpict -version 2>/dev/null | awk 'NR == 1 { print "rpict:", $0 }'
    povray --version 2>&1 | grep -om 1 'POV-Ray [0-9.]*'
    "$BAKESLAB" --version | awk 'NR == 1'
  } >versions
}

# measured WAY SETTING RUN COMMAND...: the command gets the picture's name and prints CPU
# seconds of preparing and of a picture.
measured() {
  local way=$1 setting=$2 run=$3 row
  shift 3
  row=rows/$lamp.$way.${setting//[^A-Za-z0-9,-]/_}.$run # POV-Ray takes A=B for an option
  [ ! -f "$row" ] || return 0
  echo "$lamp, $way $setting, run $run" >&2
  if ! "$@" "$BUILD/$row.npy" >"$row.cpu" 2>"$row.log"; then
    echo "run.sh: $row: $(tail -n 1 "$row.log")" >&2
    absent "$way" "failed: $(tail -n 1 "$row.log" | tr -d '|')"
    return 0
  fi
  printf '%s\t%s\t%s\t%s\t%s\n' "$lamp" "$way" "$setting" "$run" "$(tr ' ' '\t' <"$row.cpu")" >"$row.new"
  mv "$row.new" "$row"
  rm -f "$row.cpu" "$row.log"
}

mitsuba() { "$python" "$peers/mitsuba_peer.py" "$lamp" "$lamp" "$1" "$2" "$3" 0 "$4"; }
radiance() { "$python" "$peers/radiance_peer.py" "$BUILD/$lamp" "$lamp" "$1" "$2" "$3"; }

# The parabolic lamp's whole geometry in POV-Ray, by radiosity.
pov_lamp() { # SETTING PICTURE
  local scene=$lamp/lamp-$1.pov
  {
    echo '#version 3.7;'
    printf '#declare Canned_Bake_Effects = "extended_source";\n#include "%s.pov"\nglobal_settings { max_trace_level 12\n' "$lamp"
    printf '  radiosity { pretrace_start 0.08 pretrace_end 0.01 count %d, %d error_bound 0.2 nearest_count 10 recursion_limit 3\n' "$1" "${1}0"
    echo '    low_error_factor 0.7 minimum_reuse 0.01 gray_threshold 0 brightness 1 } }'
    cat "$lamp/floor.inc"
  } >"$scene"
  cpu_of "$2.cpu" povray "+I$scene" "+O${2%.npy}.exr" +W128 +H128 +FE -A -D +WT1 "+L$CANNED_INCLUDE" "+L$root/lamps"
  echo "0 $(cat "$2.cpu")"
}

# The light as the lamp's script has it shines down on the floor.
place() { [ "$lamp" = parabolic ] && echo at=0,0,0 || echo matrix=1,0,0,0,0,1,0,-1,0,0,0,0; }

# baked OPTIONS: NAME.tif and NAME.cpu, once. The headlight's script leaves light out on its left,
# 0.6 % of the flux, which the peers have: the window is widened.
baked() {
  local name=$lamp/bake${1//[^A-Za-z0-9=]/_} options
  read -ra options <<<"$1"
  sed 's/<-0.5, 0.5, -0.3, 0.15>/<-0.62, 0.5, -0.3, 0.15>/' "$root/lamps/$lamp.pov" >"$lamp/$lamp.pov"
  [ -f "$name.cpu" ] || cpu_of "$name.cpu" "$BAKESLAB" bake "$lamp/$lamp.pov" -o "$name.tif" --jobs 1 --yes -q "${options[@]}" || return 1
  echo "$name"
}

# Ten views; the picture of the first is compared, the seconds are their mean.
renderslab() { # BAKE PICTURE
  local name view
  name=$(baked "$1") || return 1
  for view in 9 8 7 6 5 4 3 2 1 0; do
    cpu_of "$2.cpu$view" "$RENDERSLAB" image "$lamp/floor.obj" --light "$name.tif $(place)" --camera "$(cat "$lamp/camera-$view")" \
      --size 128x128 --samples "$samples" --threads 1 -q -o "${2%.npy}.exr"
  done
  echo "$(cat "$name.cpu") $(cat "$2".cpu? | awk '{ t += $1 } END { print t/NR }')"
}

include() { # 'LIGHTS BAKE' PICTURE
  local name lights=${1%% *}
  name=$(baked "${1#* }") || return 1
  [ -f "$name.inc" ] || cpu_of "$name.inc.cpu" "$BAKESLAB" include "$name.tif" -o "$name.inc" -q
  "$RENDERSLAB" pov "$lamp/floor.obj" --light "$name.tif $(place)" --camera "$(cat "$lamp/camera-0")" --size 128x128 -q -o "$name.pov"
  povray_cpu "${2%.npy}.exr" "$name.pov" 128x128 "Declare=${lamp^}_Lights=$lights" "+L$lamp" >"$2.cpu"
  awk '{ t += $1 } FNR == 1 && NR < 3 { bake = t } END { print bake, $1 }' "$name.cpu" "$name.inc.cpu" "$2.cpu"
}

lamp_by() { # WAY
  local way=$1 settings setting run lights
  case $way in
  renderslab | include) mapfile -t settings <<<"${tried[bake $lamp]}" ;;
  lamp)
    [ -n "${tried[lamp $lamp]:-}" ] || return 0
    mapfile -t settings <<<"${tried[lamp $lamp]}"
    ;;
  *) mapfile -t settings <<<"${tried[$way]}" ;;
  esac
  for setting in "${settings[@]}"; do
    case $way in
    light | path)
      for run in $(seq "$RUNS"); do measured "$way" "$setting" "$run" mitsuba "${way/light/ptracer}" "$setting" "$run"; done
      ;;
    photons | mkillum) measured "$way" "$setting" 1 radiance "$way" "$setting" ;;
    lamp) measured lamp "$setting" 1 pov_lamp "$setting" ;;
    renderslab) for run in $(seq "$RUNS"); do measured "$way" "$setting" "$run" renderslab "$setting"; done ;;
    include) for lights in "${includes[@]}"; do measured "$way" "$lights $setting" 1 include "$lights $setting"; done ;;
    esac
  done
}

set_up
for lamp in ${1:-parabolic headlight}; do
  [ -d "$lamp" ] || "$python" "$peers/lamps.py" "$lamp" "$lamp"
  for half in 1 2; do
    [ -f "truth-$lamp-$half.npy" ] || "$python" "$peers/mitsuba_peer.py" "$lamp" "$lamp" ptracer "$TRUTH" "100$half" 0 \
      "$BUILD/truth-$lamp-$half.npy" >/dev/null
  done
  for way in ${2:-"${ways[@]}"}; do lamp_by "$way"; done
done
[ "$#" -eq 0 ] || exit 0
"$python" "$peers/report.py" rows
gnuplot peers.gnuplot
echo "Look at peers.md and peers.png in $BUILD"
