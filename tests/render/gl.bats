#!/usr/bin/env bats
# renderslab's method gl in pictures, and what it says where OpenGL is missing.
load letter

# picture OUT MESH OPTION...: lit from above, 80 x 60.
picture() {
  local out=$1 mesh=$2
  shift 2
  "$RENDERSLAB" image "$mesh" --light 'letter_f.tif at=0,1,0' --size 80x60 -q -o "$out" \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' "$@"
}

@test "pictures are those of the CPU's sum over views: matte, glossy, textured, lamps in view" {
  oiiotool --pattern checker:color1=0.1,0.5,0.9:color2=1,0.2,0.1 8x8 3 -o texture.png
  for mesh in floor.obj gloss.obj patches.obj; do
    picture fine.exr "$mesh" --method views --no-shadows --size 160x120
    oiiotool fine.exr --resize:filter=box 80x60 -d float -o cpu.exr
    picture gl.exr "$mesh" --method gl --no-shadows --samples 2 --stats gl.json
    below "$(relative gl.exr cpu.exr)" 0.001 || { relative gl.exr cpu.exr; return 1; }
  done
  [ "$(jq .method gl.json)" = '"gl"' ]
  [ "$(jq .microlights gl.json)" = "$(jq '.receivers*12' gl.json)" ]
}

@test "shadows are within 3 % of the CPU's" {
  picture cpu.exr occluder.obj --method views --shadow-grid 64 --shadow-edge 4096
  picture bare.exr occluder.obj --method views --no-shadows
  picture gl.exr occluder.obj --method gl
  error=$(relative gl.exr cpu.exr)
  echo "# $error % with shadows; they are $(relative bare.exr cpu.exr) % of the picture" >&3
  below "$error" 3
  below 10 "$(relative bare.exr cpu.exr)"
}

@test "the same bits again, whatever the threads; larger than a batch of receivers" {
  picture a.exr occluder.obj --method gl --threads 1 --size 700x400
  picture b.exr occluder.obj --method gl --threads 3 --size 700x400
  [ "$(oiiotool --hash a.exr | grep -o 'SHA.*')" = "$(oiiotool --hash b.exr | grep -o 'SHA.*')" ]
  picture small.exr occluder.obj --method views --size 70x40
  oiiotool a.exr --ch R,G,B --resize:filter=box 70x40 -o less.exr
  below "$(relative less.exr small.exr)" 20
}

# rejects PIECE COMMAND...: what to take instead is said too, and nothing written.
rejects() { refuses 1 "$1" '--method views' -- "${@:2}" && [ ! -e out.exr ]; }

# A map of 16384 x 16384 texels has a gigabyte.
starved() { (ulimit -v 1200000 && picture "$@"); }

@test "where OpenGL is missing or too small, one line says what, and what to take instead" {
  export __EGL_VENDOR_LIBRARY_DIRS=$PWD/none
  rejects 'EGL finds no display' picture out.exr floor.obj --method gl
  unset __EGL_VENDOR_LIBRARY_DIRS
  MESA_GL_VERSION_OVERRIDE=3.3 rejects '4.3' picture out.exr floor.obj --method gl
  [ "$CONFIG" = sanitize ] || rejects 'graphics memory' starved out.exr occluder.obj --method gl --shadow-map 16384
}

@test "slabs beyond a texture's limits are refused" {
  oiiotool --create 20000x1 3 -d float --evaloff --caption \
    '{"format": "light-slab", "version": 1, "name": "wide", "samples": [1, 1, 20000, 1], "center": [0, 0, 0], "u": [0.2, 0, 0], "v": [0, 0, 0.16], "normal": [0, -1, 0], "st_window": [-1, 1, -1, 1]}' -o wide.tif
  rejects '20000 x 1 directions a view' "$RENDERSLAB" image floor.obj --light 'wide.tif at=0,1,0' \
    --size 8x8 -q -o out.exr --method gl --camera 'from=0.3,2,-2.2 at=0,0,0.1'
}

@test "options of gl are checked" {
  local bad code
  for bad in '--shadow-map 0' '--shadow-map 99999' '--shadow-groups 0' '--gl-passes two' '--method gl --time-limit 1' '--method gles'; do
    code=0
    # shellcheck disable=SC2086
    picture out.exr floor.obj $bad || code=$?
    [ "$code" -eq 2 ] || { echo "$bad: $code"; return 1; }
  done
}
