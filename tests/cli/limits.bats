#!/usr/bin/env bats
# Headers of a few hundred bytes that claim gigabytes: refused in one line, before there is memory
# for what they claim.
# shellcheck disable=SC2154 # run sets status and stderr
load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  seeds=$BATS_TEST_DIRNAME/../fuzz/seeds
  cp "$seeds/tiff/little.tif" good.tif
}

# starved PROGRAM ARGUMENT...: in a tenth of the memory that is claimed. Sanitizers need more
# addresses than any limit leaves.
starved() { bash -c '[ "$CONFIG" = release ] && ulimit -v 1500000; "$@"' bash timeout 60 "$@" </dev/null; }

# every_command SLAB PIECE: each that reads slabs.
every_command() {
  local slab=$1 piece=$2
  for command in info check lookup "convert -o x.exr" "include --name lamp -o x.inc"; do
    # shellcheck disable=SC2086 # words
    refuses 1 "$piece" -- starved "$BAKESLAB" $command "$slab"
  done
  refuses 2 "$piece" -- starved "$BAKESLAB" diff good.tif "$slab"
  refuses 1 "$piece" -- starved "$RENDERSLAB" irradiance --light "$slab"
  [ ! -e x.exr ] && [ ! -e x.inc ]
}

# patch FILE OFFSET BYTES
patch() { printf '%b' "$3" | dd of="$1" bs=1 seek="$2" conv=notrunc status=none; }

@test "a TIFF of 530 bytes with 400 million samples" {
  every_command "$seeds/tiff/huge.tif" 'claims more samples than a file of 530 bytes can hold'
  cp "$seeds/tiff/huge.tif" plain.tif
  patch plain.tif 54 '\x01' # not compressed
  every_command plain.tif 'is truncated: pixels lie beyond the end of the file'
}

@test "an EXR of 436 bytes with 400 million samples" {
  cp "$seeds/exr/zip.exr" huge.exr
  at=$(grep -obaF dataWindow huge.exr | head -n 1 | cut -d: -f1)
  # After the attribute's name, "box2i", its size and its least corner.
  patch huge.exr $((at + 29)) '\x1f\x4e\0\0\x1f\x4e\0\0'
  every_command huge.exr 'damaged or truncated'
}

@test "descriptions with 10^18 samples" {
  raw_slab many.tif '[1000000000, 1, 1000000000, 1]' 2 2 '' 3f800000
  every_command many.tif 'are too many for one raster'
  raw_slab more.tif '[20000, 1, 20000, 1]' 2 2 '' 3f800000
  every_command more.tif 'too many for one raster'
  raw_slab some.tif '[10000, 10000, 1, 1]' 2 2 '' 3f800000
  every_command some.tif 'need 10000 x 10000 pixels'
}

# ply FORMAT COUNT LISTS: a triangle.
ply() {
  printf 'ply\nformat %s 1.0\nelement vertex %s\nproperty float x\nproperty float y\nproperty float z\n' "$1" "$2"
  printf 'element face 1\nproperty list uint int vertex_indices\nend_header\n'
  printf '0 0 0\n1 0 0\n0 1 0\n%s 0 1 2\n' "$3"
}

@test "meshes" {
  local view=(--light good.tif --camera 'from=0,0,-1 at=0,0,0' --size 8x6 -o x.exr --repair)
  ply ascii 3 3 >good.ply
  "$RENDERSLAB" image good.ply "${view[@]}" -q
  rm x.exr
  ply ascii 100000000 3 >vertices.ply
  ply ascii 3 100000000 >corners.ply
  ply binary_little_endian 100000000 3 >binary.ply
  for mesh in vertices corners binary; do
    refuses 1 "$mesh.ply: is cut off" -- starved "$RENDERSLAB" image $mesh.ply "${view[@]}"
  done
  printf 'ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n' >nothing.ply
  refuses 1 'has no properties' -- starved "$RENDERSLAB" image nothing.ply "${view[@]}"
  printf '{"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4000000000000, "uri": "data:;base64,AAAA"}], "bufferViews": [{"buffer": 0, "byteLength": 4000000000000}], "accessors": [{"bufferView": 0, "componentType": 5126, "count": 2000000000, "type": "VEC3"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}], "materials": [{}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]}' >buffer.gltf
  refuses 1 'buffer 0: has 3 bytes, and should have 4000000000000' -- starved "$RENDERSLAB" image buffer.gltf "${view[@]}"
  [ ! -e x.exr ]
}
