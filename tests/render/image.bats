#!/usr/bin/env bats
# renderslab image: what the picture shows, and what is refused.
load letter

# picture OUT OPTION...: the floor lit from above, 40 x 30.
picture() {
  local out=$1
  shift
  "$RENDERSLAB" image occluder.obj --light 'letter_f.tif at=0,1,0' --size 40x30 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' -q -o "$out" "$@"
}

# count NAME STATS: a number of the statistics.
count() { sed -n "s/.*\"$1\": \([0-9]*\).*/\1/p" "$2"; }

@test "the letter falls on the floor the right way round" {
  # One view whose rays meet the floor, 1 below, at (s, t): s to the right, t away from an eye
  # above, so that the raster's first row is the picture's last. The lamp's back is transparent.
  letter_slab one.tif one 1 1 '"center": [0, 0, 0], "u": [0.01, 0, 0], "v": [0, 0, 0.01], "normal": [0, -1, 0], "st_window": [-1, 1, -1, 1]'
  "$RENDERSLAB" image floor.obj --light 'one.tif at=0,1,0' -o above.exr --size 64x64 -q \
    --camera 'from=0,4,0 at=0,0,0 up=0,0,1 fov=28.0724869358530'
  oiiotool letter.exr --flip --resize:filter=triangle 64x64 -o right.exr
  right=$(correlation above.exr right.exr)
  echo "# right way round: $right"
  below 0.9 "$right"
  for turn in --flip --flop --rotate180 --transpose; do
    oiiotool right.exr $turn -o wrong.exr
    wrong=$(correlation above.exr wrong.exr)
    below "$wrong" 0.7 || { echo "$turn: $wrong"; return 1; }
  done
}

@test "meshes are mirrored in z; emission and background are radiances" {
  touch texture.png # loaded, but out of the picture
  oiiotool --create 2x2 3 -o texture.png
  "$RENDERSLAB" image patches.obj --light 'letter_f.tif at=0,-1,0' -o above.exr --size 40x40 -q \
    --camera 'from=0,2,0 at=0,0,0 up=0,0,1 fov=60' --background 0.5,0.25,0.125
  # OBJ's x 0.4..0.9, z -0.4..-0.9 is up and to the right; the lamp is under the floor.
  [ "$(mean_of above.exr --cut 4x4+30+7)" = 0.02,0.03,0.05 ]
  [ "$(mean_of above.exr --cut 4x4+30+30)" = 0,0,0 ]
  [ "$(mean_of above.exr --cut 4x4+7+7)" = 0,0,0 ]
  "$RENDERSLAB" image floor.obj --light letter_f.tif -o sky.exr --size 9x3 -q \
    --camera 'from=0,2,0 at=0,3,0 up=0,0,1' --background 0.5,0.25,0.125
  [ "$(mean_of sky.exr)" = 0.5,0.25,0.125 ]
}

@test "who looks into a lamp sees its slab" {
  "$RENDERSLAB" image floor.obj --light 'letter_f.tif at=0,1,0 gain=2' -o lamp.exr --size 1x1 -q \
    --camera 'from=0.02,0.5,0.03 at=0.02,1,0.03 up=0,0,1'
  seen=$(mean_of lamp.exr)
  slab=$(echo 0.02 -1 0.03 0 -1 0 | "$BAKESLAB" lookup letter_f.tif)
  echo "$seen $slab" | tr , ' ' | awk '{ exit !($4 > 0 && ($1 - 2*$4)^2 + ($2 - 2*$5)^2 + ($3 - 2*$6)^2 < 1e-10*$4^2) }'
  # Nothing of it is seen from behind, or behind something.
  "$RENDERSLAB" image floor.obj --light 'letter_f.tif at=0,1,0' -o back.exr --size 1x1 -q \
    --camera 'from=0,2,0 at=0,3,0 up=0,0,1'
  [ "$(mean_of back.exr)" = 0,0,0 ]
  "$RENDERSLAB" image floor.obj --light 'letter_f.tif at=0,1,0' -o under.exr --size 1x1 -q \
    --camera 'from=0,-1,0 at=0,3,0 up=0,0,1'
  [ "$(mean_of under.exr)" = 0,0,0 ]
}

@test "any number of threads gives the same bits, and again" {
  picture a.exr --threads 1
  picture b.exr --threads 2
  picture c.exr --threads 7
  idiff -fail 0 -warn 0 a.exr b.exr
  idiff -fail 0 -warn 0 a.exr c.exr
  picture d.exr --threads 1 --method paper --seed 3
  picture e.exr --threads 3 --method paper --seed 3
  idiff -fail 0 -warn 0 d.exr e.exr
  picture f.exr --method paper --seed 4
  run ! idiff -fail 0 -warn 0 d.exr f.exr
}

@test "samples are the means of a finer picture" {
  # A lamp without edges in its light.
  "$BAKESLAB" convert letter_f.tif -o smooth.tif --st 2x2 -q
  for out in fine.exr coarse.exr; do
    more='--size 80x60'
    [ "$out" = fine.exr ] || more='--size 40x30 --samples 2'
    # shellcheck disable=SC2086
    "$RENDERSLAB" image occluder.obj --light 'smooth.tif at=0,1,0' $more --no-shadows -q \
      --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' -o "$out" --tolerance 1e-9
  done
  oiiotool fine.exr --resize:filter=box 40x30 -d float -o means.exr
  error=$(relative coarse.exr means.exr)
  echo "# $error %"
  below "$error" 1e-4
}

@test "samples are taken where pixels differ, and nearly suffice for all" {
  picture fine.exr --size 480x360
  oiiotool fine.exr --resize:filter=box 120x90 -d float -o means.exr
  picture one.exr --size 120x90 --stats one.json
  picture four.exr --size 120x90 --samples 4 --stats four.json
  few=$(relative one.exr means.exr)
  more=$(relative four.exr means.exr)
  gathered=$(count receivers one.json)
  again=$(count receivers four.json)
  echo "# error: $few %, $more %; receivers: $gathered, $again"
  awk -v few="$few" -v more="$more" 'BEGIN { exit !(more < few/5) }'
  [ "$again" -gt "$gathered" ]
  [ "$again" -lt $((4 * gathered)) ]
  picture threads.exr --size 120x90 --samples 4 --threads 7
  idiff -fail 0 -warn 0 four.exr threads.exr
}

@test "no shadows: the floor is as bright as if nothing stood on it" {
  picture free.exr --no-shadows
  "$RENDERSLAB" image floor.obj --light 'letter_f.tif at=0,1,0' --size 40x30 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' -q -o bare.exr
  oiiotool free.exr --cut 40x4+0+26 -o free_front.exr
  oiiotool bare.exr --cut 40x4+0+26 -o bare_front.exr
  # The hits are the same but for single precision.
  error=$(relative free_front.exr bare_front.exr)
  below "$error" 1e-3
  picture shadows.exr
  run ! idiff -fail 0 -warn 0 shadows.exr free.exr
}

@test "the preview: exposure, sRGB, and what made it" {
  "$RENDERSLAB" image floor.obj --light letter_f.tif -o sky.exr --size 9x3 --exposure -1 \
    --camera 'from=0,2,0 at=0,3,0 up=0,0,1' --background 0.5,0.25,0.125 --preview sky.png
  # 1.2 cd/m2 are white at EV 0, half of that at -1: 0.5/0.6 is 235 of sRGB's 255.
  [ "$(mean_of sky.png --mulc 255)" = 235,173,126 ]
  grep -aq 'Comment.*renderslab image floor.obj' sky.png
  grep -aq 'Exposure.*0.6 is white' sky.png
  oiiotool --info -v sky.exr | grep -q 'renderslab image floor.obj'
  # The default leaves 99 % of the pixels below 0.9, and is told.
  run -0 --separate-stderr "$RENDERSLAB" image floor.obj --light letter_f.tif -o sky.exr --size 9x3 \
    --camera 'from=0,2,0 at=0,3,0 up=0,0,1' --background 0.5,0.25,0.125 --preview sky.png
  [ "$stderr" = "renderslab: sky.png: note: radiance 0.5556 is white; --exposure -1.1110 keeps it" ]
  [ "$(mean_of sky.png --mulc 255)" = 243,179,130 ]
  "$RENDERSLAB" image floor.obj --light letter_f.tif -o same.exr --size 9x3 -q --exposure auto \
    --camera 'from=0,2,0 at=0,3,0 up=0,0,1' --background 0.5,0.25,0.125 --preview same.png
  idiff -fail 0 -warn 0 sky.png same.png
  # An exposure by which nothing is seen is told.
  run -0 --separate-stderr "$RENDERSLAB" image floor.obj --light letter_f.tif -o sky.png --size 9x3 \
    --exposure 6 --camera 'from=0,2,0 at=0,3,0 up=0,0,1' --background 0.5,0.25,0.125
  [ "$stderr" = "renderslab: sky.png: note: --exposure 6 leaves it nearly black; auto would take -1.1" ]
}

@test "-o x.png is the preview itself" {
  picture a.exr --preview a.png --exposure -6
  picture b.png --exposure -6
  idiff -fail 0 -warn 0 a.png b.png
  [ "$(head -c 8 b.png)" = "$(head -c 8 a.png)" ]
}

@test "what is ignored is told by name, and a scale= that was forgotten; -q silences" {
  # A lamp in centimetres, 20 wide over a floor of 6.
  letter_slab cm.tif cm 1 1 '"metres_per_unit": 0.01, "center": [0, 0, 0], "u": [20, 0, 0], "v": [0, 0, 16], "normal": [0, -1, 0], "st_window": [-1, 1, -1, 1]'
  sed 's/^Kd.*/&\nd 0.5/' -i floor.mtl
  good=(image floor.obj --camera 'from=0,2,-3 at=0,0,0' --size 8x6 -o a.exr)
  run -0 --separate-stderr "$RENDERSLAB" "${good[@]}" --light 'cm.tif at=0,1,0' --light cm.tif
  # shellcheck disable=SC2154 # stderr_lines is set by run
  [ "${#stderr_lines[@]}" -eq 2 ]
  [[ ${stderr_lines[0]} == "renderslab: floor.obj: note: transparency is ignored, surfaces are opaque: '"*"'" ]]
  [[ ${stderr_lines[1]} == "renderslab: cm.tif: note: it is 20 wide, "*" scale=0.01 "* ]]
  run -0 --separate-stderr "$RENDERSLAB" "${good[@]}" -q --light 'cm.tif at=0,1,0'
  [ -z "$stderr" ]
  run -0 --separate-stderr "$RENDERSLAB" "${good[@]}" --light 'cm.tif at=0,1,0 scale=0.01'
  [ "${#stderr_lines[@]}" -eq 1 ]
  run --separate-stderr "$RENDERSLAB" "${good[@]}" --light cm.tif --camera Eye
  [ "$status" -eq 1 ]
  [[ $stderr == *"has no camera 'Eye', but none at all"* ]]
}

@test "statistics" {
  picture a.exr --stats a.json
  for key in '"command": "renderslab image occluder.obj ' '"total": ' '"receivers": ' '"microlights": ' \
    '"nodes": ' '"shadow_rays": ' '"shadows": {' '"simulated": true' '"error_estimate": ' '"gloss": {' '"simulated": false'; do
    grep -qF "$key" a.json || { echo "no $key"; return 1; }
  done
  run ! grep -q '"shadow_rays": 0,' a.json
  picture a.exr --no-shadows --stats a.json
  grep -q '"shadow_rays": 0,' a.json
  grep -qF -- --no-shadows a.json
}

@test "a bar is drawn on a terminal only, and -q silences it" {
  needs script # gives the program a terminal, where the machine has any to give
  script -qec true /dev/null </dev/null >/dev/null || skip "this machine gives no terminals"
  line="$RENDERSLAB image occluder.obj --light 'letter_f.tif at=0,1,0' --size 40x30 --samples 2 --camera 'from=0.3,2,-2.2 at=0,0,0.1' -o a.exr"
  script -qec "$line" /dev/null </dev/null >with.txt
  grep -q 'image \[' with.txt
  script -qec "$line -q" /dev/null </dev/null >without.txt
  [ ! -s without.txt ]
  run --separate-stderr picture a.exr
  [ -z "$output$stderr" ]
}

# rejects PIECE OPTION...: refused, and nothing is left.
rejects() { harmless "$1" "$RENDERSLAB" image "${@:2}"; }

@test "bad meshes" {
  good=(--light letter_f.tif --camera 'from=0,2,-3 at=0,0,0' -o a.exr)
  sed 's/^v 3 0 3/v nan 0 3/' floor.obj >nan.obj
  sed 's/^v .*/v 1 0 1/' floor.obj >flat.obj
  grep -v '^vn' floor.obj | sed 's,//1,,g' >normals.obj
  sed '/^mtllib/d; /^usemtl/d' floor.obj >materials.obj
  echo "no mesh" >text.obj
  : >empty.obj
  remember
  rejects nothere.obj nothere.obj "${good[@]}"
  rejects nan.obj nan.obj "${good[@]}"
  rejects flat.obj flat.obj "${good[@]}"
  rejects normals.obj normals.obj "${good[@]}"
  rejects materials.obj materials.obj "${good[@]}"
  rejects text.obj text.obj "${good[@]}"
  rejects empty.obj empty.obj "${good[@]}"
  rejects scenes . "${good[@]}" || rejects . . "${good[@]}"
  rejects mesh "${good[@]}"
  rejects two.obj floor.obj two.obj "${good[@]}"
  # Mended, those without normals or materials show something.
  "$RENDERSLAB" image normals.obj "${good[@]}" -q --repair --size 40x30
  "$RENDERSLAB" image materials.obj "${good[@]}" -q --repair --size 40x30
}

@test "bad lights and methods" {
  good=(floor.obj --camera 'from=0,2,-3 at=0,0,0' -o a.exr)
  remember
  rejects light "${good[@]}"
  rejects nothere.tif "${good[@]}" --light nothere.tif
  rejects floor.obj "${good[@]}" --light floor.obj
  rejects matrix "${good[@]}" --light 'letter_f.tif matrix=1,0,0,1,0,0,0,0,1,0,0,0'
  rejects toward "${good[@]}" --light 'letter_f.tif at=1,1,1 toward=1,1,1'
  rejects scale "${good[@]}" --light 'letter_f.tif scale=0'
  rejects "auto, reference, paper, midpoint, pi, closed, views" "${good[@]}" --light letter_f.tif --method best
  rejects 'it is for paper, paper-levels' "${good[@]}" --light letter_f.tif --seed 1
  rejects 'not with --method pi' "${good[@]}" --light letter_f.tif --method pi --level 2
  rejects shadow-grid "${good[@]}" --light letter_f.tif --method gl --shadow-grid 8
  rejects 'it is for gl' "${good[@]}" --light letter_f.tif --shadow-map 512
  rejects highlight gloss.obj "${good[@]:1}" --light letter_f.tif --method closed
  rejects tolerance "${good[@]}" --light letter_f.tif --tolerance 0
  rejects tolerance "${good[@]}" --light letter_f.tif --tolerance nan
  rejects threads "${good[@]}" --light letter_f.tif --threads 0
  rejects shadow-edge "${good[@]}" --light letter_f.tif --shadow-grid 32 --shadow-edge 16
  rejects 'shadow-edge 4097: must be a whole number from 1 to 4096' "${good[@]}" --light letter_f.tif --shadow-edge 4097
}

@test "bad sizes, cameras and outputs" {
  good=(floor.obj --light letter_f.tif --camera 'from=0,2,-3 at=0,0,0')
  mkdir folder
  remember
  for size in 0 0x10 10x0 2147483648 2147483648x1 1x2147483648 65537 -1 10x 1e3 '' nan; do
    rejects size "${good[@]}" -o a.exr "--size=$size"
  done
  for camera in '' nonsense 'from=0,0,0' 'from=0,0,0 at=0,0,0' 'from=0,0,0 at=0,1,0' \
    'from=nan,0,0 at=0,1,2' 'from=0,0 at=0,1,2' 'from=0,0,0 at=0,1,2 fov=180' 'from=0,0,0 at=0,1,2 fov=0'; do
    rejects "" floor.obj --light letter_f.tif -o a.exr "--camera=$camera"
  done
  rejects camera floor.obj --light letter_f.tif -o a.exr
  rejects samples "${good[@]}" -o a.exr --samples 0
  rejects 'exposure 1,2: must be auto or a number' "${good[@]}" -o a.exr --exposure 1,2
  rejects exposure "${good[@]}" -o a.exr --exposure 101
  rejects background "${good[@]}" -o a.exr --background 1,2
  rejects output "${good[@]}"
  rejects .exr "${good[@]}" -o a.jpg
  rejects .exr "${good[@]}" -o .png
  rejects nowhere "${good[@]}" -o nowhere/a.exr
  rejects nowhere "${good[@]}" -o a.exr --preview nowhere/a.png
  rejects nowhere "${good[@]}" -o a.exr --stats nowhere/a.json
  rejects folder "${good[@]}" -o a.exr --stats folder
  rejects a.exr "${good[@]}" -o a.exr --stats a.exr
  rejects floor.obj "${good[@]}" -o a.exr --preview floor.obj
  rejects letter_f.tif "${good[@]}" -o a.exr --preview letter_f.tif
}

@test "a time limit: the coarsest picture in any case, and how good it is" {
  run -0 --separate-stderr "$RENDERSLAB" image occluder.obj --light 'letter_f.tif at=0,1,0' --size 40x32 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' -o late.exr --time-limit 0.001
  # shellcheck disable=SC2154
  [[ $stderr == *"0.001 s do not suffice; the least here is about "* ]]
  [[ $stderr == *"relative error at most"*"4 x 4 pixels share a ray"* ]]
  # Blocks of 4 x 4 pixels are the pixels of a picture of 10 x 8; their errors are not known.
  picture small.exr --size 10x8
  oiiotool small.exr --resize:filter=box 40x32 -d float -o blocks.exr
  error=$(relative late.exr blocks.exr)
  echo "# blocks: $error %"
  below "$error" 5
  [[ $(oiiotool --stats -a late.exr) == *"InfCount: 1280 1280 1280"* ]]
  picture free.exr
  picture timed.exr --time-limit 1000
  oiiotool free.exr timed.exr --diff # all that was asked for, in the end
  remember
  for limit in 0 -1 nan x; do
    rejects limit floor.obj --light letter_f.tif --camera 'from=0,2,-3 at=0,0,0' -o a.exr --time-limit "$limit"
  done
}

@test "a time limit is kept, files and all, whatever the samples and the method" {
  [[ $CONFIG != @(sanitize|thread) ]] || skip "all is slower"
  # One thread's processor time, since other programs may have the processors.
  for more in '' '--samples 8' '--method reference' '--size 640x480 --preview a.png'; do
    # shellcheck disable=SC2086
    cpu=$( (TIMEFORMAT='%U %S' && time picture timed.exr --time-limit 0.4 --threads 1 --size 320x240 $more) 2>&1)
    echo "# $more: $cpu"
    awk -v cpu="$cpu" 'BEGIN { split(cpu, part, " "); exit !(part[1] + part[2] < 0.44) }'
  done
}

@test "what is skipped changes nothing but the cost" {
  picture auto.exr --stats auto.json
  picture all.exr --effects all --stats all.json
  oiiotool auto.exr all.exr --diff
  [ "$(count open_views auto.json)" -gt 0 ]
  [ "$(count open_views all.json)" -eq 0 ]
  [ "$(count shadow_rays auto.json)" -lt "$(count shadow_rays all.json)" ]
}

@test "a picture too large for the memory" {
  [[ $CONFIG != @(sanitize|thread) ]] || skip "shadow memory needs more than the limit"
  remember
  ulimit -v 8000000
  rejects memory floor.obj --light letter_f.tif --camera 'from=0,2,-3 at=0,0,0' -o a.exr --size 65536
}
