#!/usr/bin/env bats
# Tiles that different processes render, put together: the whole picture, to the last bit, and what
# is refused.
load letter

# scene OUT OPTION...: the floor under the letter, 16 x 45, whose last row of tiles is cut.
scene() {
  local out=$1
  shift
  "$RENDERSLAB" image occluder.obj --light 'letter_f.tif at=0,1,0' --size 16x45 --tolerance 0.05 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' -q -o "$out" "$@"
}

# same A B: all values of both parts.
same() {
  local part
  for part in 0 1; do
    oiiotool "$1" --subimage $part "$2" --subimage $part --fail 0 --hardfail 0 --diff || return 1
  done
}

@test "tiles joined are the whole picture, their counts its counts" {
  local n k names samples
  for samples in 1 3; do
    scene whole.exr --samples $samples --stats whole.json
    for n in 1 $((3 + samples)); do
      rm -f tile*.exr
      for ((k = n; k > 0; --k)); do scene tile$k.exr --samples $samples --tile $k/$n --threads $k; done
      "$RENDERSLAB" join tile*.exr -o joined.exr --stats joined.json --preview joined.png --exposure 3 -q
      same whole.exr joined.exr || { echo "$samples $n"; return 1; }
      names=receivers,microlights,nodes,black_microlights,shadow_rays,pages_behind,error_estimate
      [ "$(jq -c "[.[\"${names//,/\",\"}\"]]" whole.json)" = "$(jq -c "[.[\"${names//,/\",\"}\"]]" joined.json)" ] || {
        diff whole.json joined.json
        return 1
      }
    done
  done
}

@test "what makes no picture is refused, and nothing is written" {
  local k
  for k in 1 2 3; do scene tile$k.exr --tile $k/3; done
  scene other.exr --tile 2/3 --tolerance 0.02
  scene four.exr --tile 4/4
  scene whole.exr
  refuses 1 "1 of the 3 tiles are missing: tile 2" -- "$RENDERSLAB" join tile1.exr tile3.exr -o x.exr
  refuses 1 "other.exr: is a tile of another picture than tile1.exr" \
    -- "$RENDERSLAB" join tile1.exr other.exr tile3.exr -o x.exr
  refuses 1 "four.exr: is one of 4 tiles, tile1.exr one of 3" -- "$RENDERSLAB" join tile1.exr four.exr -o x.exr
  refuses 1 "tile2.exr: tile 2 is given twice" -- "$RENDERSLAB" join tile2.exr tile2.exr -o x.exr
  refuses 1 "whole.exr: " -- "$RENDERSLAB" join whole.exr -o x.exr
  truncate -s 2000 tile2.exr
  refuses 1 "tile2.exr: " -- "$RENDERSLAB" join tile1.exr tile2.exr tile3.exr -o x.exr
  refuses 2 "--tile 0/3: not a part" -- scene x.exr --tile 0/3
  refuses 2 "--tile 1/7: the picture has fewer rows" -- scene x.exr --tile 1/7
  refuses 2 "--tile: writes an .exr" -- scene x.png --tile 1/3
  refuses 2 "--tile: not with --time-limit" -- scene x.exr --tile 1/3 --time-limit 1
  [ ! -e x.exr ] && [ ! -e x.png ]
}
