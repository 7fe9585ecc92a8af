#!/usr/bin/env bats
# info, check, lookup, convert, diff on slabs that are written byte by byte here.

load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  # 2 x 1 views of 2 x 2: red ramps 1 2 3 4 along the raster's row, green 0.5, blue 0
  raw_slab a.tif '[2, 1, 2, 2]' 4 2 ', "name": "ramp", "x-key": [7]' \
    3f800000 3f000000 00000000  40000000 3f000000 00000000 \
    40400000 3f000000 00000000  40800000 3f000000 00000000
  one=3f800000
}

@test "info prints geometry, flux and peak" {
  run -0 --separate-stderr "$BAKESLAB" info a.tif
  [[ $output == *"a.tif: page 1 of 1: ramp"* ]]
  [[ $output == *"2 x 1 x 2 x 2, float"* ]]
  [[ $output == *"st distance"*"infinite"* ]]
  [[ $output == *"4 0.5 0"*"at sample (1, 0, 1, 0)"* ]]
}

@test "info --json: a constant slab has Lambert's flux" {
  # radiance 1: 0.04 * 4 corner(1,1), corner = atan(1/sqrt 2)/sqrt 2 = 0.435209...
  raw_slab one.tif '[1, 1, 1, 1]' 1 1 ', "metres_per_unit": 0.5, "radiance_unit": "W/(sr m2)"' "$one" "$one" "$one"
  run -0 --separate-stderr "$BAKESLAB" info --json one.tif
  flux=$(tr -d ' \n' <<<"$output" | sed 's/.*"flux":\[\([0-9.e-]*\),.*/\1/')
  awk -v f="$flux" 'BEGIN { c = atan2(1, sqrt(2)) / sqrt(2); e = 0.04 * 4 * c * 0.25; exit !(f/e - 1 < 1e-6 && 1 - f/e < 1e-6) }'
  [[ $output == *'"flux_unit": "W"'* ]]
}

@test "info and the include tell the same flux, with lengths in metres" {
  raw_slab small.tif '[1, 1, 4, 4]' 4 4 ', "name": "small", "metres_per_unit": 0.01' "$one" "$one" "$one"
  "$BAKESLAB" include small.tif -o small.inc
  told=$(sed -n 's,.*flux at Scale 1\, Gain 1: \([0-9.e-]*\) .*,\1,p' small.inc)
  flux=$("$BAKESLAB" info --json small.tif | tr -d ' \n' | sed 's/.*"flux":\[\([0-9.e-]*\),.*/\1/')
  awk -v t="$told" -v f="$flux" 'BEGIN { c = atan2(1, sqrt(2)) / sqrt(2); e = 0.04 * 4 * c * 1e-4
    exit !(t/e - 1 < 1e-3 && 1 - t/e < 1e-3 && f/e - 1 < 1e-6 && 1 - f/e < 1e-6) }'
}

@test "lookup answers rays, in order, outside with zeros" {
  run -0 --separate-stderr "$BAKESLAB" lookup a.tif <<'END'
# i=0: a=-0.05; k=1: s=0.5; any point of the ray will do
-0.05 0 0   0.5 -1 0
0.45 -1 0.25   0.5 -1 0.25
0 0 0   0 1 0

9 0 0   0 -1 0
0 0 0   0 -2 0
END
  [ "${lines[0]}" = "2 0.5 0" ]
  [ "${lines[1]}" = "2 0.5 0" ]
  [ "${lines[2]}" = "0 0 0" ]
  [ "${lines[3]}" = "0 0 0" ]
  [ "${lines[4]}" = "2.5 0.5 0" ]
  [ "${#lines[@]}" -eq 5 ]
}

@test "lookup refuses bad lines by number" {
  for line in "1 2 3 4 5" "1 2 3 4 5 6 7" "0 0 0 0 0 0" "0 0 nan 0 -1 0" "a b c d e f" "0 0 0 0 inf 0"; do
    refuses 1 "stdin: line 2" -- "$BAKESLAB" lookup a.tif <<<"0 0 0 0 -1 0
$line"
  done
  refuses 2 "-: the rays come from stdin" -- "$BAKESLAB" lookup - <a.tif
  refuses 1 "a.tif: has no page 2" -- "$BAKESLAB" lookup --page 2 a.tif </dev/null
}

@test "lookup adds pages, --page takes one" {
  "$BAKESLAB" convert a.tif -o f.tif --precision float
  needs tiffcp
  tiffcp f.tif f.tif two.tif
  run --separate-stderr "$BAKESLAB" lookup two.tif <<<"0 0 0 0 -1 0"
  [ "$output" = "5 1 0" ]
  run --separate-stderr "$BAKESLAB" lookup --page 2 two.tif <<<"0 0 0 0 -1 0"
  [ "$output" = "2.5 0.5 0" ]
}

@test "a slab on stdin" {
  run -0 --separate-stderr "$BAKESLAB" info - <a.tif
  [[ $output == *"2 x 1 x 2 x 2"* ]]
}

@test "convert: every container keeps the samples, keys and history" {
  "$BAKESLAB" convert a.tif -o b.exr
  "$BAKESLAB" convert b.exr -o c.tif --precision half
  "$BAKESLAB" convert c.tif -o d.exr --precision half
  "$BAKESLAB" convert d.exr -o e.tif --precision float
  run -0 --separate-stderr "$BAKESLAB" diff a.tif e.tif
  grep -aq '"x-key": \[7\]' e.tif
  run --separate-stderr "$BAKESLAB" info --json e.tif
  [[ $output == *"bakeslab convert d.exr -o e.tif --precision float"* ]]
  [[ $output == *'"history"'*"bakeslab convert a.tif -o b.exr"*"bakeslab convert b.exr"* ]]
}

@test "an EXR that another program saved: lossy compression is told, or refused by name" {
  needs oiiotool
  printf -v ramp '%08x ' $((0x3f800001)) $((0x3f912345)) $((0x3fabcdef)) # no halves
  # shellcheck disable=SC2086
  raw_slab f.tif '[2, 1, 16, 16]' 32 16 '' $ramp
  "$BAKESLAB" convert f.tif -o float.exr
  "$BAKESLAB" convert f.tif -o half.exr --precision half
  # FROM COMPRESSION, and whether it changes samples
  while read -r from compression changes; do
    oiiotool "$from.exr" --compression "$compression" -o saved.exr
    [ "$changes" = yes ] || "$BAKESLAB" diff --tolerance 0 "$from.exr" saved.exr
    run -0 --separate-stderr "$BAKESLAB" info saved.exr
    [[ ${output^^} == *"LOSSY COMPRESSION ${compression^^}"* ]] && told=yes || told=no
    [ "$told" = "$changes" ] || { echo "$from $compression: told $told"; false; }
    run -0 --separate-stderr "$BAKESLAB" check saved.exr
    [[ $output == *"warning: its samples were changed by the lossy"* ]] && told=yes || told=no
    [ "$told" = "$changes" ]
  done <<'END'
half rle no
half piz no
half pxr24 no
half b44 yes
half b44a yes
float zips no
float none no
END
  oiiotool float.exr --compression pxr24 -o saved.exr
  run -0 --separate-stderr "$BAKESLAB" info --json saved.exr
  [[ $output == *'"lossy": "PXR24"'* ]]
  # OpenEXRCore 3.1 cannot decode DWA, and decodes floats of B44 wrongly
  for compression in dwaa dwab b44 b44a; do
    oiiotool float.exr --compression "$compression" -o saved.exr
    refuses 1 "saved.exr: page 1: is compressed by ${compression^^}, which is lossy" -- "$BAKESLAB" info saved.exr
  done
  cp half.exr new.exr # the attribute's name, type and size come before it
  at=$(grep -obaF compression new.exr | head -n 1 | cut -d: -f1)
  printf '\x0b' | dd of=new.exr bs=1 seek=$((at + 28)) conv=notrunc status=none
  refuses 1 "new.exr: its compression is not known" -- "$BAKESLAB" info new.exr
  oiiotool half.exr --attrib:type='float[8]' chromaticities 1,0,0,1,0,0,0.3333,0.3333 -o xyz.exr
  refuses 1 "xyz.exr: page 1: has chromaticities other than Rec. 709's" -- "$BAKESLAB" info xyz.exr
}

@test "convert: resolution and crop" {
  "$BAKESLAB" convert a.tif -o mean.exr --uv 1x1 --st 1
  run --separate-stderr "$BAKESLAB" lookup mean.exr <<<"0 0 0 0 -1 0"
  [ "$output" = "2.5 0.5 0" ]
  "$BAKESLAB" convert a.tif -o crop.exr --crop uv=1:2,0:1 --crop st=0:1,0:2
  # centre (0.05, 0, 0), slopes -1..0
  run --separate-stderr "$BAKESLAB" lookup crop.exr <<<"0.05 0 0 -0.5 -1 0
0.05 0 0 0.5 -1 0
-0.05 0 0 -0.5 -1 0"
  [ "${lines[0]}" = "3 0.5 0" ]
  [ "${lines[1]}" = "0 0 0" ]
  [ "${lines[2]}" = "0 0 0" ]
  refuses 1 "a.tif: page 1" "crop u" -- "$BAKESLAB" convert a.tif -o x.exr --crop uv=1:3,0:1
  [ ! -e x.exr ]
}

@test "convert refuses what a precision cannot hold, and leaves nothing" {
  raw_slab neg.tif '[1, 1, 1, 1]' 1 1 '' bf800000 bf800000 bf800000
  refuses 1 "out.tif: page 1: sample (0, 0, 0, 0)" "--precision float" -- "$BAKESLAB" convert neg.tif -o out.tif
  raw_slab big.tif '[1, 1, 1, 1]' 1 1 '' 47c35000 "$one" "$one"
  refuses 1 "out.exr: page 1" "--precision float" -- "$BAKESLAB" convert big.tif -o out.exr --precision half
  [ -z "$(ls out* 2>/dev/null)" ]
}

@test "diff: 0 same, 1 differ, 2 trouble" {
  "$BAKESLAB" convert a.tif -o l.tif
  run -1 --separate-stderr "$BAKESLAB" diff a.tif l.tif
  [[ $output == *"rmse"*"largest"*"flux"* ]]
  run -0 --separate-stderr "$BAKESLAB" diff --tolerance 0.03 a.tif l.tif
  "$BAKESLAB" convert a.tif -o s.exr --uv 1x1
  run -1 --separate-stderr "$BAKESLAB" diff --tolerance 9 a.tif s.exr
  [[ $output == *'"samples" differs'* ]]
  refuses 2 "none.tif" "No such file" -- "$BAKESLAB" diff a.tif none.tif
  run -2 --separate-stderr "$BAKESLAB" diff a.tif
}

@test "check: warnings are no errors, unless --strict" {
  run -0 --separate-stderr "$BAKESLAB" check a.tif
  [[ $output == *"warning: light is cut off, some "*" % of it beyond the windows: the ends of "*"page 1 high s"* ]]
  [[ $output == *"a.tif: page 1: valid"* ]]
  run -1 --separate-stderr "$BAKESLAB" check --strict a.tif
  raw_slab dark.tif '[1, 1, 3, 1]' 3 1 '' 0000000000000000000000003f8000003f8000003f800000000000000000000000000000
  run -0 --separate-stderr "$BAKESLAB" check --strict dark.tif
  [[ $output != *warning* ]]
}

@test "check: flux at the aperture and on a box around; light that is there twice" {
  needs tiffcp
  raw_slab even.tif '[1, 1, 2, 2]' 2 2 ', "metres_per_unit": 2' "$one" "$one" "$one"
  run -0 --separate-stderr "$BAKESLAB" check even.tif
  [[ $output =~ "flux 0.2785 0.2785 0.2785 relative m2 sr at the aperture, "[+-][0-9.e-]+" % on a closed box around (known to 0.0" ]]
  [[ $output != *twice* ]]
  tiffcp even.tif even.tif two.tif
  run -0 --separate-stderr "$BAKESLAB" check two.tif
  [[ $output == *"two.tif: page 1: warning: 100 % of its flux leaves through the aperture of page 2 too, and is there twice"* ]]
}

@test "bad files: one line with file, page and reason, by every command" {
  raw_slab nan.tif '[2, 1, 2, 2]' 4 2 '' "$one" "$one" "$one" "$one" 7fc00000 "$one"
  raw_slab wrong.tif '[2, 1, 2, 3]' 4 2 '' "$one"
  version=2 raw_slab new.tif '[2, 1, 2, 2]' 4 2 '' "$one"
  raw_slab twice.tif '[2, 1, 2, 2]' 4 2 ', "version": 1' "$one"
  head -c 300 a.tif >cut.tif
  head -c -1 a.tif >short.tif
  : >empty.tif
  echo "not a slab" >text.tif
  for command in info check lookup "convert -o out.exr" diff; do
    for bad in nan.tif wrong.tif new.tif twice.tif cut.tif short.tif empty.tif text.tif none.tif .; do
      other=
      want=1
      if [ "$command" = diff ]; then other=a.tif want=2; fi
      # shellcheck disable=SC2086
      refuses $want "$bad: " -- "$BAKESLAB" $command $bad $other <<<"0.05 0 0 0 -1 0"
      case $bad in
      nan.tif) why='page 1: sample (0, 0, 1, 0) is not finite' ;;
      wrong.tif) why='page 1: "samples" 2 x 1 x 2 x 3 need 4 x 3 pixels, there are 4 x 2' ;;
      new.tif) why='page 1: version 2 of the format is unknown (this program reads version 1)' ;;
      twice.tif) why='page 1: malformed JSON: line 1: duplicate object key' ;;
      cut.tif | short.tif) why='truncated' ;;
      empty.tif) why='is empty' ;;
      text.tif) why='neither TIFF nor EXR' ;;
      none.tif) why='No such file or directory' ;;
      .) why='Is a directory' ;;
      *) false ;;
      esac
      [[ $stderr == *"$why"* ]] || { echo "$bad: '$stderr' does not say '$why'"; false; }
    done
  done
  [ ! -e out.exr ]
  # before any sample is asked for
  refuses 1 "short.tif: page 1: is truncated" -- "$BAKESLAB" lookup short.tif </dev/null
}

@test "convert to stdout: the same slab as in a file" {
  for more in "" "--precision float" "--precision half"; do
    # shellcheck disable=SC2086
    "$BAKESLAB" convert a.tif -o file.tif $more
    # shellcheck disable=SC2086
    "$BAKESLAB" convert a.tif -o - $more >piped.tif
    # shellcheck disable=SC2086
    "$BAKESLAB" convert - -o - $more <a.tif | cat | "$BAKESLAB" diff - file.tif
    run -0 --separate-stderr "$BAKESLAB" diff file.tif piped.tif
  done
  [ ! -e - ]
  raw_slab neg.tif '[1, 1, 1, 1]' 1 1 '' bf800000 bf800000 bf800000
  refuses 1 "stdout: page 1: sample (0, 0, 0, 0)" "--precision float" -- "$BAKESLAB" convert neg.tif -o -
  [ -z "$output" ]
  [ -c /dev/full ] || skip "no /dev/full"
  run -1 bash -c '"$0" convert a.tif -o - 2>err >/dev/full' "$BAKESLAB"
  grep -q "bakeslab: stdout: cannot be written: No space left" err
}

@test "-q is taken by every command and silences notes, not errors" {
  for command in "info a.tif" "check a.tif" "lookup a.tif" "convert a.tif -o q.exr" "diff a.tif a.tif" \
    "include a.tif -o q.inc"; do
    for option in -q --quiet; do
      # shellcheck disable=SC2086
      run -0 --separate-stderr "$BAKESLAB" $command $option <<<"0 0 0 0 -1 0"
      [ -z "$stderr" ]
    done
  done
  raw_slab odd.tif '[1, 1, 1, 1]' 1 1 ', "name": "odd", "provenance": {"housing": "#end"}' "$one"
  run -0 --separate-stderr "$BAKESLAB" include odd.tif -o odd.inc
  [[ $stderr == "bakeslab: odd.tif: note: its housing is left out"* ]]
  run -0 --separate-stderr "$BAKESLAB" include -q odd.tif -o odd.inc
  [ -z "$stderr" ]
  refuses 1 "none.tif: No such file" -- "$BAKESLAB" info -q none.tif
}

@test "usage errors exit 2 and say what is wrong" {
  for arguments in "" "frobnicate" "info" "info a.tif b.tif" "info --nonsense a.tif" "lookup --page 0 a.tif" \
    "convert a.tif" "convert a.tif a.tif -o x.tif" "include a.tif" "include -o x.inc" "convert -o x.tif" "convert a.tif -o x.tif --precision double" \
    "convert a.tif -o x.tif --uv 0x3" "convert a.tif -o x.tif --st 3x" "convert a.tif -o x.tif --crop uv=2:1,0:1" \
    "diff a.tif a.tif --tolerance x"; do
    # shellcheck disable=SC2086
    run -2 --separate-stderr "$BAKESLAB" $arguments
    [ -n "$stderr" ]
    [ -z "$output" ]
  done
}

@test "help and version go to stdout, with examples" {
  for command in info check lookup convert diff; do
    run -0 --separate-stderr "$BAKESLAB" $command --help
    [[ $output == *"Usage: bakeslab $command"*"Examples:"*"bakeslab $command"* ]]
    [ "$("$BAKESLAB" help $command)" = "$output" ]
  done
  run -0 --separate-stderr "$BAKESLAB" --version
  [[ $output == bakeslab\ [0-9]* ]]
}

@test "a full stdout is an error" {
  [ -c /dev/full ] || skip "no /dev/full"
  for command in "info a.tif" "info --json a.tif" "check a.tif" "lookup a.tif" "info --help" "--help" "--version"; do
    # shellcheck disable=SC2086
    run -1 bash -c "echo 0 0 0 0 -1 0 | \"\$0\" $command 2>err >/dev/full" "$BAKESLAB"
    grep -q "bakeslab: stdout: No space left" err
  done
  run -2 bash -c '"$0" diff a.tif a.tif 2>err >/dev/full' "$BAKESLAB"
}

@test "a closed pipe is an error" {
  mkfifo pipe
  # 4 writes into a pipe that nobody reads any more
  run -1 bash -c 'trap "" PIPE; exec 3<>pipe 4>pipe 3<&-; "$0" info a.tif 2>err >&4' "$BAKESLAB"
  grep -q "bakeslab: stdout: Broken pipe" err
}

@test "an output that cannot be written" {
  refuses 1 "none/out.tif" "No such file" -- "$BAKESLAB" convert a.tif -o none/out.tif
  mkdir folder.tif
  refuses 1 "folder.tif" "not a regular file" -- "$BAKESLAB" convert a.tif -o folder.tif
  refuses 1 "out.png" ".exr" -- "$BAKESLAB" convert a.tif -o out.png
  [ "$(id -u)" -eq 0 ] && return
  mkdir locked
  chmod a-w locked
  refuses 1 "locked/out.tif" "Permission denied" -- "$BAKESLAB" convert a.tif -o locked/out.tif
}

@test "a disk that fills: the old file stays, nothing else does" {
  [ "$(id -u)" -eq 0 ] || skip "needs root to mount"
  mkdir disk
  mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null || skip "cannot mount"
  "$BAKESLAB" convert a.tif -o noise.exr --uv 60x60 --st 16x16
  for name in out.tif out.exr; do
    echo old >disk/$name
    refuses 1 "disk/$name" "No space left" -- "$BAKESLAB" convert noise.exr -o disk/$name --precision float ||
      { umount disk; false; }
    [ "$(cat disk/$name)" = old ]
    [ "$(find disk -type f | wc -l)" -eq 1 ] || { umount disk; false; }
    rm disk/$name
  done
  umount disk
}
