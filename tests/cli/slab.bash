# slab.bash - what the command-line tests share: refusals, and small slabs that are made without our
# own writer, as an uncompressed big-endian float TIFF of one strip, by printf.
# shellcheck shell=bash
load ../testing

# raw_slab FILE SAMPLES(JSON) WIDTH HEIGHT MORE_JSON HEXFLOATS...
# The variables `version` and `window` may name another version of the format, another st window.
# The floats (8 hex digits each) repeat until the raster is full.
raw_slab() {
  local file=$1 samples=$2 width=$3 height=$4 more=$5
  shift 5
  local text="{\"format\": \"light-slab\", \"version\": ${version:-1}, \"samples\": $samples, \"center\": [0, 0, 0], \"u\": [0.2, 0, 0], \"v\": [0, 0, 0.2], \"normal\": [0, -1, 0], \"st_window\": [${window:--1, 1, -1, 1}]$more}"
  local values=$((3 * width * height)) entries=11 hex
  local directory=8 length=$((${#text} + 1))
  local after=$((directory + 2 + 12 * entries + 4))
  local pixels=$((after + length + 12))
  short() { printf '%04x0003%08x%04x0000' "$1" 1 "$2"; }
  long() { printf '%04x0004%08x%08x' "$1" 1 "$2"; }
  hex=$(printf '4d4d002a%08x%04x' $directory $entries)
  hex+=$(long 256 "$width")$(long 257 "$height")
  hex+=$(printf '%04x0003%08x%08x' 258 3 $((after + length)))
  hex+=$(short 259 1)$(short 262 2)
  hex+=$(printf '%04x0002%08x%08x' 270 $length $after)
  hex+=$(long 273 $pixels)$(short 277 3)$(long 278 "$height")$(long 279 $((4 * values)))
  hex+=$(printf '%04x0003%08x%08x' 339 3 $((after + length + 6)))00000000
  hex+=$(printf '%s' "$text" | od -An -v -tx1 | tr -d ' \n')00
  hex+=002000200020000300030003
  local data=$* one
  data=${data// /}
  one=$data
  while [ ${#data} -lt $((8 * values)) ]; do data+=$one; done
  hex+=${data:0:$((8 * values))}
  # shellcheck disable=SC2059 # the bytes are the format
  printf "$(printf '%s' "$hex" | sed 's/../\\x&/g')" >"$file"
}
